#!/usr/bin/env bash
# Runs a fuzz target on GLSL for 20 s; what it found interesting stays in CORPUS for the next time.
#   run_target.sh TARGET GENERATE_PROGRAM SOURCE_FOLDER CORPUS
set -euo pipefail
target=$1 generate=$2 source=$3 corpus=$4
mkdir -p "$corpus"
for shader in "$source"/shaders/exact/*.glsl "$source"/tests/translate/shaders/*.frag "$source"/tests/translate/kernels/*.glsl \
  "$source"/tests/fuzz/hostile/*.frag; do
  cp "$shader" "$corpus/seed_$(basename "$shader")"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do "$generate" $seed "$corpus/seed_$seed.frag"; done
# Leaks are glslang's (see cmake/leaks.supp); a child that dies in a trial is no finding.
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1
exec "$target" -max_total_time=20 -timeout=30 -rss_limit_mb=4096 -max_len=8192 -print_final_stats=1 \
  -artifact_prefix="$corpus/../" "$corpus"
