#!/usr/bin/env bash
# The main job on the built-in scene: installs packages, builds, draws the courtyard by every technique on the CPU, EGL and
# OSMesa, compares the frames bit by bit, and leaves pictures and a table in out/demo.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/packages.sh
cmake --preset release >/dev/null
cmake --build --preset release
mkdir -p out/demo
build/release/twinshade compare courtyard --technique all --on cpu,egl,osmesa --size 1280x800 -o out/demo | tee out/demo/table.txt
echo "pictures and table: out/demo"
