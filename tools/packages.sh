#!/usr/bin/env bash
# Installs what the build needs, from Debian 12's packages; nothing to do where all are there already. Sourced by the
# other scripts, runs alone too. "all" adds what `tools/test.sh --all` needs, "emulator" what tools/emulate_avx512.sh does.
set -euo pipefail

packages=(ca-certificates cmake ninja-build clang g++ binutils pkg-config
  glslang-dev glslang-tools spirv-headers libglm-dev libopenimageio-dev doctest-dev
  libegl-dev libgl-dev libegl1 libegl-mesa0 libgl1-mesa-dri libosmesa6 libosmesa6-dev
  libcairo2-dev fonts-dejavu-core
  libeigen3-dev libembree-dev libtbb-dev libassimp-dev libcli11-dev nlohmann-json3-dev libfmt-dev gdb)
if [ "${1:-}" = all ]; then
  packages+=(libclang-rt-14-dev g++-aarch64-linux-gnu qemu-user)
elif [ "${1:-}" = emulator ]; then
  packages+=(bochs bochsbios vgabios isolinux syslinux-common xorriso busybox-static cpio)
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  if [ "$(id -u)" -eq 0 ]; then root=(); else root=(sudo); fi
  echo "installing: ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  "${root[@]}" apt-get update -qq
  "${root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi
