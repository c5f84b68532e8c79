#!/usr/bin/env bash
# talus batch under mpirun: the rows are those of one process, bad input and an unwritable folder end all processes.
# Usage: mpi.sh TALUS SOURCE_DIR. Exit code 77: skipped, unless TALUS_NO_SKIP is set.
set -euo pipefail
talus=$1 source_dir=$2

skip() { echo "skipped: $1"; [ -z "${TALUS_NO_SKIP-}" ] || exit 1; exit 77; }
command -v mpirun >/dev/null || skip "no mpirun (Debian package openmpi-bin)"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

sed 's/^samples = .*/samples = 30/; s/^mean = 30.0/mean = 24.0/; s/"truncated-normal"/"normal"/; /^min = 20/d; /^max = 40/d; s/^sd = 2.5/sd = 14/' \
    "$source_dir/bench/sweeps/reliability.toml" |
    sed "s|../examples/|$source_dir/bench/examples/|" >"$work/sweep.toml"
rows() {  # rows without the processor time, in order
    python3 - "$1" <<'PY'
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1])))
for row in sorted(rows, key=lambda row: int(row["run"])):
    row["cpu_seconds"] = ""
    print(list(row.values()))
PY
}
status_of() { local status=0; "$@" >/dev/null 2>&1 || status=$?; echo "$status"; }

# Some of these friction angles are no angles: those runs fail, the batch goes on and says 3.
[ "$(status_of "$talus" batch "$work/sweep.toml" -o "$work/one" --quiet)" = 3 ]
[ "$(status_of mpirun --oversubscribe -n 3 "$talus" batch "$work/sweep.toml" -o "$work/three" --quiet)" = 3 ]
diff <(rows "$work/one/results.csv") <(rows "$work/three/results.csv")
grep -q ',failed,' "$work/three/results.csv"

[ "$(status_of mpirun --oversubscribe -n 2 "$talus" batch "$work/none.toml" -o "$work/x" --quiet)" = 2 ]
touch "$work/file"
[ "$(status_of mpirun --oversubscribe -n 2 "$talus" batch "$work/sweep.toml" -o "$work/file/x" --quiet)" = 4 ]
echo "mpirun: same rows from one process and from three"
