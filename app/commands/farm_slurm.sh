#!/bin/bash
# Made by weft farm: submits %COUNT% of `weft render`, and a job that checks all frames and draws
# what is missing. Options are for sbatch: `bash SCRIPT --partition=gpu`.
%TASKS%
self=$(realpath -- "${BASH_SOURCE[0]}")
submit() { sbatch --parsable --requeue --chdir=%FOLDER% --output=%x_%j.log "$@"; }
jobs=
if %IN_ORDER%; then  # each task needs what the one before it has drawn
  for i in "${!frames[@]}"; do
    jobs=$(submit --job-name=weft_render ${jobs:+"--dependency=afterany:${jobs%%;*}"} "$@" "$self" task "$i") || exit
  done
else
  jobs=$(submit --job-name=weft_render --array=0-$((${#frames[@]} - 1)) "$@" "$self" task) || exit
fi
gather=$(submit --job-name=weft_gather --dependency="afterany:${jobs%%;*}" "$@" "$self" gather) || exit
echo "the last job is ${gather%%;*}; its log says how many frames were done already"
