#!/usr/bin/env bash
# The same frame from x86-64 and, under qemu, from AArch64, for every number type.
#   compare_hashes.sh TWINSHADE NATIVE_HASH_FRAME AARCH64_HASH_FRAME WORK_FOLDER IDENTIFIER...
set -euo pipefail
twinshade=$1 native=$2 foreign=$3 work=$4
shift 4
mkdir -p "$work"
techniques=$(printf '%s,' "${@%_lightmap}")
TWINSHADE_CACHE="$work/cache" "$twinshade" bake courtyard --technique "${techniques%,}" --lightmap 64 --rays 16 \
  --size 200x120 --quiet -o "$work/aarch64.bundle" >/dev/null
failures=0
for identifier in "$@"; do
  expected=$("$native" "$work/aarch64.bundle" "$identifier" lanes4)
  for number in lanes4 lanes8 lanes16 scalar; do
    hash=$(qemu-aarch64 "$foreign" "$work/aarch64.bundle" "$identifier" $number 2)
    printf '%-20s %-8s %s\n' "$identifier" "$number" "$hash"
    if [ "$hash" != "$expected" ]; then
      echo "differs from x86-64: $expected" >&2
      failures=1
    fi
  done
done
exit $failures
