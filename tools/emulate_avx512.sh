#!/usr/bin/env bash
# Runs a command on an emulated processor with AVX-512 (Bochs), for machines that have none: its bits, not its speed.
#   tools/emulate_avx512.sh COMMAND FILE...
# COMMAND is a line of shell; each FILE, a program or a folder, is carried along and lies under its own name in the
# folder that it runs in. Programs find the libraries that they are linked with. Prints what COMMAND prints, ends as it
# does. A boot takes minutes; one process that does much takes less than many.
#   twinshade bake quad --technique all --lightmap 32 --volume 4x2x4 --map-width 8 --size 320x200 -o quad.bundle
#   twinshade golden update goldens quad.bundle --technique all
#   tools/emulate_avx512.sh 'TWINSHADE_ISA=avx512 ./twinshade golden check goldens' build/release/twinshade \
#     build/release/twinshade_image_codec.so goldens quad.bundle
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: tools/emulate_avx512.sh COMMAND FILE..." >&2; exit 2; }
command=$1
shift
folder=$(cd "$(dirname "$0")/.." && pwd)

"$folder/tools/packages.sh" emulator

work=$(mktemp -d)
trap 'kill "${emulator:-}" 2>/dev/null || true; rm -rf "$work"' EXIT

# Debian's kernel, not installed; what runs is in memory alone.
(cd "$work" && apt-get download -qq "$(apt-cache depends linux-image-cloud-amd64 | awk '/Depends:/ {print $2; exit}')" &&
  dpkg-deb -x linux-image*.deb kernel && rm linux-image*.deb) 2>/dev/null
mkdir -p "$work"/{image/isolinux,root/{bin,proc,sys,dev,tmp,job}}
cp "$work"/kernel/boot/vmlinuz-* "$work/image/vmlinuz"
cp /usr/lib/ISOLINUX/isolinux.bin /usr/lib/syslinux/modules/bios/ldlinux.c32 "$work/image/isolinux/"
cp /bin/busybox "$work/root/bin/"
for file in "$@"; do
  cp -rL "$file" "$work/root/job/"
  for library in $([ ! -f "$file" ] || ldd "$file" 2>/dev/null | grep -oE '/[^ ]+'); do
    mkdir -p "$work/root$(dirname "$library")"
    cp -L "$library" "$work/root$library"
  done
done
printf '%s\n' "$command" >"$work/root/job/.command"
cat >"$work/root/init" <<'INIT'
#!/bin/busybox sh
/bin/busybox mount -t proc proc /proc
/bin/busybox mount -t sysfs sys /sys
/bin/busybox mount -t devtmpfs dev /dev
/bin/busybox --install -s /bin
export PATH=/bin HOME=/tmp
grep -q avx512vl /proc/cpuinfo || echo "the emulated processor has no AVX-512"
cd /job
echo "@begin"
# Not to a terminal, where programs would show their progress.
{ sh .command; echo "@end $?"; } 2>&1 | cat
sleep 60 # until what is above has gone through the serial line; whoever started the emulator stops it then
poweroff -f
INIT
chmod +x "$work/root/init"
(cd "$work/root" && find . | cpio -o -H newc --quiet) >"$work/image/initrd"
# Bochs 2.7 tells of a compacted state that it does not save, and where protection keys lie: without these the kernel
# would use neither AVX nor AVX-512.
cat >"$work/image/isolinux/isolinux.cfg" <<'BOOT'
default linux
timeout 1
label linux
 kernel /vmlinuz
 append initrd=/initrd console=ttyS0 quiet nokaslr mitigations=off nosmp tsc=reliable lpj=1000000 nopku clearcpuid=pku,xsavec,xsaves
BOOT
xorriso -as mkisofs -quiet -o "$work/boot.iso" -b isolinux/isolinux.bin -c isolinux/boot.cat -no-emul-boot \
  -boot-load-size 4 -boot-info-table "$work/image" 2>/dev/null
cat >"$work/bochsrc" <<BOCHS
config_interface: textconfig
display_library: rfb, options="timeout=0"
memory: guest=2048, host=2048
romimage: file=/usr/share/bochs/BIOS-bochs-latest
vgaromimage: file=/usr/share/vgabios/vgabios.bin
boot: cdrom
ata0-master: type=cdrom, path=$work/boot.iso, status=inserted
cpu: model=corei7_skylake_x, count=1, ips=50000000, ignore_bad_msrs=1
clock: sync=none
com1: enabled=1, mode=file, dev=$work/serial
log: $work/bochs.log
panic: action=report
error: action=ignore
info: action=ignore
BOCHS
# Debian's Bochs stops in its debugger first, whose input must stay open.
mkfifo "$work/debugger"
exec 9<>"$work/debugger"
bochs -q -f "$work/bochsrc" <&9 >"$work/bochs.out" 2>&1 &
emulator=$!
echo c >&9
touch "$work/serial"
while ! grep -q '^@end' "$work/serial" && kill -0 "$emulator" 2>/dev/null; do sleep 2; done
tr -d '\r' <"$work/serial" | sed -n '/^@begin/,/^@end/p' | grep -v '^@' || true
status=$(tr -d '\r' <"$work/serial" | sed -n 's/^@end //p')
[ -n "$status" ] || { echo "the emulator stopped:" >&2; tail -n 3 "$work/bochs.log" "$work/serial" >&2; exit 2; }
exit "$status"
