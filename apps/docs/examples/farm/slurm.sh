#!/bin/bash
#SBATCH --job-name=catalogue
#SBATCH --array=0-239
#SBATCH --gpus-per-task=1
#SBATCH --cpus-per-task=4
#SBATCH --mem=16G
#SBATCH --time=00:30:00
#SBATCH --signal=TERM@60

# A minute before the time limit the task saves its samples in the store;
# submitted again, it continues from there.
exec glanz farm task catalogue.csv --store /mnt/farm \
  --image "$SLURM_ARRAY_TASK_ID"
