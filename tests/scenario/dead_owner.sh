#!/usr/bin/env bash
# Flies a mission live with a pair of executives; the owner of commands hangs, and in the same moment the executive that leads is killed.
#   dead_owner.sh BIN_FOLDER MISSION DDS DOMAIN SPEED
# Prints steps as ground_and_kills.sh does: flying (the status), lacks (the log's line of the other executive that would lead, before the owner is
# back), launch (exit code and summary) and effects (what the robot did).
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 speed=$5
folder=$(mktemp -d)
trap 'kill -KILL $launcher $(pgrep -P $launcher) 2>/dev/null; rm -rf "$folder"' EXIT

step() {  # name exit_code output
  printf '%s\t%s\t%s\n' "$1" "$2" "$3"
}
flying() { kill -0 $launcher 2>/dev/null; }

"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --standby --clock live --speed $speed --watchdog 4 --headless --json --run-folder "$folder/run" \
  >"$folder/summary" 2>"$folder/errors" &
launcher=$!
while flying && status=$(timeout 40 "$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain" status --json) &&
  ! [[ $status =~ \"standby_ready\":true.*\"phase\":\"executing\" ]]; do :; done
step flying 0 "$status"
owner=$(pgrep -P $launcher -x sim_svc)
kill -STOP $owner
kill -KILL "$(grep -o '"leader":"[^}]*"process_id":[0-9]*' <<<"$status" | grep -o '[0-9]*$')"
grep -qm1 'would lead' < <(tail -q -n +1 -F --pid=$owner "$folder"/run/exec_svc*.log 2>/dev/null)
step lacks 0 "\"$(grep -h 'would lead' "$folder"/run/exec_svc*.log | tail -n 1)\""
wait $launcher
step launch $? "$(tail -n 1 "$folder/summary")"
step effects 0 "[$(paste -sd , "$folder/run/effects.jsonl")]"
