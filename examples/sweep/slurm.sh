#!/bin/sh
# The sweep as a SLURM job array, without Dask: each job runs its share of the batches on its cores
# and writes them into the shared folder OUT. Afterwards one call without --share gathers the parts,
# runs what is missing and draws the map:
#
#     job=$(sbatch --parsable --array=0-39 slurm.sh)
#     sbatch --dependency=afterany:"$job" slurm.sh
#
#SBATCH --cpus-per-task=8
#SBATCH --time=01:00:00
set -eu
OUT=${OUT:-sweep}
SETS=${SETS:-20000}
if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
    exec python sweep.py --out "$OUT" --sets "$SETS" --share "$SLURM_ARRAY_TASK_ID" "$SLURM_ARRAY_TASK_COUNT"
fi
exec python sweep.py --out "$OUT" --sets "$SETS"
