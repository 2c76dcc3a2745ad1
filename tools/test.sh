#!/usr/bin/env bash
# Installs packages, builds `release` and runs every test that is not labelled slow.
#   tools/test.sh --all   also the slow tests, g++, the sanitizers and AArch64
set -euo pipefail
cd "$(dirname "$0")/.."
all=no
case "${1:-}" in
  "") ;;
  --all) all=yes ;;
  *) echo "usage: tools/test.sh [--all]" >&2; exit 2 ;;
esac

if [ $all = yes ]; then tools/packages.sh all; else tools/packages.sh; fi

build() { cmake --preset "$1" >/dev/null && cmake --build --preset "$1"; }

build release
if [ $all = no ]; then
  ctest --preset release --parallel 2 --label-exclude slow
  exit
fi
cmake --build --preset release --target slow_tests benches
ctest --preset release --parallel 2
for preset in gcc asan tsan; do
  build $preset
  ctest --preset $preset --parallel 2 --label-exclude "slow|across-builds"
done
tools/same_bits.sh build/release/twinshade build/gcc/twinshade
