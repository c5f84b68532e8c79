#!/usr/bin/env bash
# The wheel can be made and works once it is unpacked. Usage: wheel.sh PYTHON BUILD_DIR SOURCE_DIR
set -euo pipefail
python=$1 build=$2 source=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

PYTHONPATH=$source/tools/python/backend "$python" -B -c "
import wheel
print(wheel.build_wheel('$work', {'build-dir': '$build'}))" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
unzip=("$python" -m zipfile -e "$work"/talus-*.whl "$work/unpacked")
"${unzip[@]}"
cd "$work"
PYTHONPATH=$work/unpacked "$python" -c "
import talus
assert talus.__file__.startswith('$work'), talus.__file__
result = talus.critical_angle('$source/bench/paper/fissure-1.toml')
assert result.status == 'found', result"
