#!/bin/bash
#SBATCH --job-name=planemotion
#SBATCH --array=1-4
#SBATCH --cpus-per-task=2
#SBATCH --output=shard-%a.log
# Computes the shards of a study:  sbatch array.sh study.toml result
# and then, by a job that waits for the last one or by hand:  planemotion merge study.toml --out result
set -euo pipefail
planemotion sweep "$1" --out "$2" --workers "$SLURM_CPUS_PER_TASK" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
