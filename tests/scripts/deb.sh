#!/usr/bin/env bash
# The Debian package can be made, and the program in it runs. Usage: deb.sh BUILD_DIR CPACK
set -euo pipefail
build=$1 cpack=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cpack" --config "$build/CPackConfig.cmake" -G DEB -B "$work" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
package=$(echo "$work"/talus_*.deb)
dpkg-deb -c "$package" >"$work/files"
for file in ./usr/bin/talus ./usr/share/bash-completion/completions/talus ./usr/include/talus/model.h \
    ./usr/include/talus/formats/scenario.h; do
    grep -q " $file\$" "$work/files" || { echo "$file is missing"; exit 1; }
done
[[ $(dpkg-deb -f "$package" Depends) == *libtbb* ]] || { echo "its dependencies lack TBB"; exit 1; }
dpkg-deb -x "$package" "$work/root"
"$work/root/usr/bin/talus" --version
