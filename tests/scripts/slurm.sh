#!/usr/bin/env bash
# A real Slurm of one node on loopback, set up in a folder of its own, runs the example job array; the merged rows are
# those of one process. Usage: slurm.sh TALUS SOURCE_DIR. Exit code 77: skipped, unless TALUS_NO_SKIP is set.
set -euo pipefail
talus=$(realpath "$1") source_dir=$(realpath "$2")

skip() { echo "skipped: $1"; [ -z "${TALUS_NO_SKIP-}" ] || exit 1; exit 77; }
PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch squeue; do
    command -v "$program" >/dev/null || skip "no $program (Debian package slurm-wlm)"
done
[ "$(id -u)" = 0 ] || skip "Slurm's daemons want root here"

work=$(mktemp -d -t talus-slurm-XXXXXX)
chmod 755 "$work"
pids=()
stop() {
    for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
    wait 2>/dev/null || true
    rm -rf "$work"
}
trap stop EXIT
give_up() { echo "$1"; tail -n 20 "$work"/*.log; exit 1; }

mkdir -m 700 "$work/munge"
dd if=/dev/urandom of="$work/munge/key" bs=128 count=1 status=none
chmod 400 "$work/munge/key"
socket=$work/munge.socket
munged --foreground --force --key-file="$work/munge/key" --socket="$socket" --pid-file="$work/munge/pid" \
    --log-file="$work/munge.log" --seed-file="$work/munge/seed" >/dev/null 2>&1 &
pids+=($!)

host=$(hostname -s)
port=$((20000 + RANDOM % 20000))
mkdir "$work/state" "$work/spool"
cat >"$work/slurm.conf" <<CONF
ClusterName=talus
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
echo "CgroupPlugin=cgroup/v1" >"$work/cgroup.conf"
export SLURM_CONF=$work/slurm.conf

for _ in $(seq 50); do [ -S "$socket" ] && break; sleep 0.1; done
slurmctld -D -f "$SLURM_CONF" >/dev/null 2>&1 &
pids+=($!)
slurmd -D -f "$SLURM_CONF" -N "$host" >/dev/null 2>&1 &
pids+=($!)
for _ in $(seq 300); do
    sinfo -h -o %T 2>/dev/null | grep -q idle && break
    sleep 0.1
done
sinfo -h -o %T 2>/dev/null | grep -q idle || give_up "Slurm's node did not come up"

export TALUS=$talus SWEEP=$source_dir/bench/sweeps/grid.toml OUT=$work/out
sbatch --quiet --chdir="$work" --array=1-3 "$source_dir/bench/cluster/batch-array.sh"
for _ in $(seq 600); do
    [ -z "$(squeue -h)" ] && break
    sleep 0.2
done
[ -z "$(squeue -h)" ] || give_up "the job array did not end"

"$talus" merge "$OUT" >/dev/null || { cat "$work"/talus-*.log; give_up "the shards are not complete"; }
"$talus" batch "$SWEEP" -o "$work/one" --quiet >/dev/null
without_time() {
    local time
    time=$(head -n 1 "$1" | tr , '\n' | grep -nx cpu_seconds | cut -d: -f1)
    cut -d, --complement -f"$time" "$1" | sort -n
}
diff <(without_time "$OUT/results.csv") <(without_time "$work/one/results.csv")
echo "Slurm: three array tasks, $(($(wc -l <"$OUT/results.csv") - 1)) rows, the same as from one process"
