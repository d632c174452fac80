#!/usr/bin/env bash
# A live mission whose two executives have a disk each; that of the first, which leads, is full for more than ten seconds.
#   full_disk_pair.sh BIN_FOLDER MISSION DDS DOMAIN
# The disk is a small file system in memory: call it with `unshare -rm`; exit code 77 where that may not be mounted.
# Prints steps as ground_and_kills.sh does: flying, replaced (the second leads), add (a goal sent meanwhile), full (its exit
# code: for how many seconds it was full), joined (the first stands by), achieved, robot and second (exit code and summary
# of each launcher) and effects (what the robot did).
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4
folder=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null; wait; umount "$folder/first"; rm -rf "$folder"' EXIT
mkdir "$folder/first"
mount -t tmpfs -o size=3m,mode=700 tmpfs "$folder/first" || exit 77

launch() {  # name services options…; in a subshell, whose place it takes
  exec timeout 250 "$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --shared-domain --run full-disk --services $2 \
    --clock live --speed 30 --headless --json --run-folder "$folder/$1" "${@:3}" >"$folder/$1.summary" 2>"$folder/$1.log"
}
step() {  # name exit_code output
  printf '%s\t%s\t%s\n' "$1" "$2" "$3"
}
roci() {
  timeout 60 "$bin/roci" --dds "$dds" --domain "$domain" "$@" --json
}
until_status() {  # name pattern: asks until the status shows it, or the run is over
  local status=""
  while kill -0 $robot 2>/dev/null; do
    status=$(roci status)
    [[ $status =~ $2 ]] && break
  done
  step "$1" 0 "$status"
}

launch robot arm_svc,pathplan_svc,planner_svc,science_svc,sim_svc &
robot=$!
launch first exec_svc --standby &
first=$!
launch second exec_svc.standby --standby &
second=$!
until_status flying '"leader":"first".*"standby_ready":true.*"phase":"executing"'
begun=$SECONDS
dd if=/dev/zero of="$folder/first/fill" bs=64k 2>/dev/null
dd if=/dev/zero of="$folder/first/fill2" bs=1 count=65536 2>/dev/null
until_status replaced '"leader":"second"'
step add $? "$(roci goal add more photo x=60 y=45)"
while ((SECONDS - begun < 11)); do roci status >/dev/null; done
step full $((SECONDS - begun)) '""'
rm "$folder/first/fill" "$folder/first/fill2"
until_status joined '"standby_ready":true'
until_status achieved '("state":"achieved".*){4}'
kill -TERM $robot $first $second 2>/dev/null
for name in robot first second; do
  wait ${!name}
  step $name $? "$(tail -n 1 "$folder/$name.summary")"
done
step effects 0 "[$(paste -sd , "$folder/robot/effects.jsonl")]"
