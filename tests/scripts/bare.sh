#!/usr/bin/env bash
# The README's two commands on a bare Debian 12: makes one in FOLDER/system (debootstrap), puts the last commit of ROOT into it and
# runs both there. By hand: it needs root, a network, 4 GB and the time of a whole build. Usage: bare.sh ROOT FOLDER
set -euo pipefail
root=$1 folder=$2
system=$folder/system

mkdir -p "$folder"
[ -e "$system/etc/debian_version" ] || debootstrap --variant=minbase bookworm "$system"
rm -rf "$system/src"
mkdir -p "$system/src"
git -C "$root" archive HEAD | tar x -C "$system/src"
cp /etc/resolv.conf "$system/etc/resolv.conf"
mountpoint -q "$system/proc" || mount -t proc proc "$system/proc"
mkdir -p "$system/dev/pts"  # tests of the terminal open one
mountpoint -q "$system/dev/pts" || mount -t devpts devpts "$system/dev/pts"
trap 'umount "$system/dev/pts" "$system/proc"' EXIT

run() {
    local begin=$SECONDS
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 chroot "$system" bash -c "cd /src && $1" </dev/null
    echo "--- $1: $((SECONDS - begin)) s"
}
run tools/paper
run tools/check
# What the build brings besides: Python finds the package, manual pages are there.
run "PYTHONPATH=build/python /usr/bin/python3 -c 'import talus; print(talus.__version__)'"
run "cmake --install build --prefix /usr/local >/dev/null && test -s /usr/local/share/man/man1/talus-run.1 && /usr/local/bin/talus --version"
