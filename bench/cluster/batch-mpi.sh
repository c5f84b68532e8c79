#!/usr/bin/env bash
# A batch over the nodes of one Slurm job, runs handed out one by one (Talus built with -DTALUS_MPI=ON).
#   sbatch --ntasks=64 bench/cluster/batch-mpi.sh
#SBATCH --job-name=talus
#SBATCH --time=01:00:00
set -euo pipefail

: "${TALUS:=talus}"
: "${SWEEP:=sweep.toml}"
: "${OUT:=out}"

exec mpirun "$TALUS" batch "$SWEEP" -o "$OUT" --quiet
