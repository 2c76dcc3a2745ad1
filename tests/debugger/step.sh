#!/usr/bin/env bash
# gdb steps through the GLSL of a shader's scalar build: the lines in order, the author's names, their values.
#   step.sh PROGRAM SCRIPT.gdb      exit 77: skipped
set -euo pipefail
if ! command -v gdb >/dev/null; then
  echo "SKIPPED: gdb is not installed (package gdb): nobody steps through GLSL here" >&2
  exit 77
fi
output=$(gdb -nx -batch -x "$2" "$1" 2>&1) || { echo "$output"; exit 1; }
at=0
# Each must follow the one before.
while IFS= read -r wanted; do
  rest=${output:at}
  case "$rest" in
    *"$wanted"*) ;;
    *) echo "gdb did not show, in this order: $wanted"; echo "$output"; exit 1 ;;
  esac
  before=${rest%%"$wanted"*}
  at=$((at + ${#before} + ${#wanted}))
done <<'EXPECTED'
float a = x * 3.0;
float b = twice(a);
{e = {6}}
float sum = v + v;
return sum;
{e = {12}}
if (b > 10.0) {
b = b - 1.0;
for (int i = 0; i < 2; ++i) {
b = b + 0.5;
{e = {11.5}}
EXPECTED
echo "gdb stepped through the GLSL"
