#!/usr/bin/env bash
# A batch as a Slurm job array: each task computes one shard with one thread. Copy, and change the four lines below.
#   sbatch --array=1-8 bench/cluster/batch-array.sh
# Once all tasks are done:  talus merge "$OUT"
# A task that was killed may be started again (sbatch --array=3 ...): it goes on where it was.
#SBATCH --job-name=talus
#SBATCH --cpus-per-task=1
#SBATCH --time=01:00:00
#SBATCH --output=talus-%A-%a.log
set -euo pipefail

: "${TALUS:=talus}"
: "${SWEEP:=sweep.toml}"
: "${OUT:=out}"

exec "$TALUS" batch "$SWEEP" -o "$OUT" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --threads 1 --quiet
