#!/bin/bash
#SBATCH --job-name=catalogue
#SBATCH --array=0-239
#SBATCH --gres=gpu:1
#SBATCH --cpus-per-task=4
#SBATCH --mem=16G
#SBATCH --time=00:30:00
#SBATCH --signal=B:TERM@60

# A minute before the time limit the task saves its samples in the store;
# submitted again, it continues from there. "B:" sends the signal to the
# process of this script, which exec makes that of glanz.
exec glanz farm task catalogue.csv --store /mnt/farm \
  --image "$SLURM_ARRAY_TASK_ID"
