#!/usr/bin/env bash
# The same bundle and the same frame, to the bit, however they are made: lane widths, instruction sets, tile sizes, thread
# counts, masked processor features, Embree's instruction sets, and further binaries (another compiler's, say).
#   tools/same_bits.sh TWINSHADE [OTHER_TWINSHADE ...]
# Bakes each variant of the bake anew in a cache of its own. Prints a line per variant, exits 1 at the first that differs.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tools/same_bits.sh TWINSHADE [OTHER_TWINSHADE ...]" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
scene=(courtyard --technique h6,sh3,pca8,cutout,facets --lightmap 64 --rays 64 --visibility-rays 64)
features=-FMA,-FMA4,-AVX2,-AVX2_Usable,-AVX512F,-ERMS

# Variables of the environment and options of the variant at hand.
environment=()
options=()

expected_bundle=
check_bake() {  # label, binary
  local label=$1 binary=$2 bundle="$work/$1.bundle" hash
  mkdir -p "$work/cache-$label"
  env TWINSHADE_CACHE="$work/cache-$label" ${environment[@]+"${environment[@]}"} "$binary" bake "${scene[@]}" \
    --size 320x200 --quiet ${options[@]+"${options[@]}"} -o "$bundle" >/dev/null
  hash=$(sha256sum <"$bundle" | cut -d' ' -f1)
  printf 'bake   %-24s %s\n' "$label" "$hash"
  if [ -z "$expected_bundle" ]; then
    expected_bundle=$hash
    cp "$bundle" "$work/reference.bundle"
  elif [ "$hash" != "$expected_bundle" ]; then
    echo "differs from the first: $label" >&2
    exit 1
  fi
  rm -rf "$bundle" "$work/cache-$label"
}

declare -A expected_frame
check_frame() {  # label, binary
  local label=$1 binary=$2 technique hash
  for technique in h6 sh3 pca8 cutout facets; do
    hash=$(env ${environment[@]+"${environment[@]}"} "$binary" render "$work/reference.bundle" --technique $technique --on cpu \
      --quiet ${options[@]+"${options[@]}"} -o "$work/frame.exr" | awk '$1 == "frame" {print $2}')
    [ -n "$hash" ] || { echo "no frame hash: $label $technique" >&2; exit 1; }
    printf 'frame  %-24s %-7s %s\n' "$label" $technique "$hash"
    if [ -z "${expected_frame[$technique]:-}" ]; then
      expected_frame[$technique]=$hash
    elif [ "$hash" != "${expected_frame[$technique]}" ]; then
      echo "differs from the first: $label $technique" >&2
      exit 1
    fi
  done
}

first=$1
shift
for threads in 2 1 7; do
  options=(--threads $threads)
  check_bake threads-$threads "$first"
  check_frame threads-$threads "$first"
done
options=()
environment=("GLIBC_TUNABLES=glibc.cpu.hwcaps=$features")
check_bake masked-features "$first"
check_frame masked-features "$first"
environment=(TWINSHADE_EMBREE_ISA=sse2)
check_bake embree-sse2 "$first"
if grep -q avx2 /proc/cpuinfo; then
  environment=(TWINSHADE_EMBREE_ISA=avx2)
  check_bake embree-avx2 "$first"
fi
environment=()

for tile in 16 32 64 128; do
  options=(--tile $tile)
  check_frame tile-$tile "$first"
done
for number in lanes4 lanes8 lanes16 scalar; do
  options=(--number $number --isa baseline)
  check_frame $number-baseline "$first"
done
if grep -q avx2 /proc/cpuinfo; then
  options=(--number lanes8 --isa avx2)
  check_frame lanes8-avx2 "$first"
fi
if grep -q avx512vl /proc/cpuinfo; then
  options=(--number lanes16 --isa avx512)
  check_frame lanes16-avx512 "$first"
fi
options=()

number=2
for other in "$@"; do
  check_bake binary-$number "$other"
  check_frame binary-$number "$other"
  number=$((number + 1))
done
echo "all the same"
