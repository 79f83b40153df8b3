#!/usr/bin/env bash
# Usage: status.sh JOB
# Says whether a Slurm job is running, has ended well or has failed, in the words of Snakemake.
set -euo pipefail

# Right after it was submitted a job may not be known yet: that is waiting, too.
state=$(sacct --jobs="$1" --allocations --noheader --parsable2 --format=State | head -n 1)
case ${state%% *} in
  COMPLETED) echo success ;;
  "" | PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | RESIZING) echo running ;;
  *) echo failed ;;
esac
