#!/usr/bin/env bash
# The Debian packages can be made, and what is in them runs. Usage: deb.sh BUILD_DIR CPACK [PYTHON]
set -euo pipefail
build=$1 cpack=$2 python=${3-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cpack" --config "$build/CPackConfig.cmake" -G DEB -B "$work" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
check_files() {
    dpkg-deb -c "$1" >"$work/files"
    for file in "${@:2}"; do
        grep -q " $file" "$work/files" || { echo "$1 lacks $file"; exit 1; }
    done
    [[ $(dpkg-deb -f "$1" Depends) == *libtbb* ]] || { echo "the dependencies of $1 lack TBB"; exit 1; }
    dpkg-deb -x "$1" "$work/root"
}
check_files "$(echo "$work"/talus_*.deb)" ./usr/bin/talus ./usr/share/bash-completion/completions/talus \
    ./usr/include/talus/model.h ./usr/include/talus/formats/scenario.h \
    ./usr/share/man/man1/talus.1 ./usr/share/man/man1/talus-critical-angle.1
"$work/root/usr/bin/talus" --version
[ -n "$python" ] || exit 0
check_files "$(echo "$work"/python3-talus_*.deb)" ./usr/lib/python3/dist-packages/talus/_core. \
    ./usr/lib/python3/dist-packages/talus/__init__.py ./usr/lib/python3/dist-packages/talus/compas.py
PYTHONPATH=$work/root/usr/lib/python3/dist-packages "$python" -c "import talus, talus.compas; print(talus.__version__, talus.__file__)"
