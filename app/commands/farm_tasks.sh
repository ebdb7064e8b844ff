frames=(%FRAMES%)
case ${1-} in
  task) number=${2:-$SLURM_ARRAY_TASK_ID} set=${frames[number]} ;;
  gather) set=%ALL% ;;
  *) set= ;;
esac
if [ -n "$set" ]; then
  for try in 1 2 3; do
    (%RENDER% "--frames=$set") && exit
    code=$?
    echo "try $try of 3 of frames $set: exit code $code" >&2
  done
  exit "$code"
fi
