#!/usr/bin/env bash
# Flies a mission on the live clock, freezes the robot's service, sends a goal, so that the executive waits for the robot
# to stop, and kills the frozen service. The launcher starts it again.
#   kill_in_pause.sh BIN_FOLDER MISSION DDS DOMAIN
# Prints steps as ground_and_kills.sh does; "run" is the launcher's exit code and summary, "replay" what roci replay says.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4
folder=$(mktemp -d)
trap 'kill -KILL $launcher $(pgrep -P $launcher) 2>/dev/null; rm -rf "$folder"' EXIT

roci() { timeout 40 "$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain" "$@" --json; }
step() {  # name output
  printf '%s\t%s\t%s\n' "$1" 0 "$2"
}
until_status() {  # name pattern: asks until the status shows it, at most so often
  local status=""
  for _ in $(seq 60); do
    status=$(roci status)
    [[ $status =~ $2 ]] && break
  done
  step "$1" "$status"
}

"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --clock live --speed 10 --headless --json \
  --run-folder "$folder/run" >"$folder/summary" &
launcher=$!
until_status flying '"phase":"executing"'
robot=$(pgrep -P $launcher sim_svc)
kill -STOP "$robot"
step add "$(roci goal add more photo x=55 y=40)"
until_status pausing '"phase":"pausing"'
kill -KILL "$robot"
until_status again '"phase":"executing"'
kill -TERM $launcher
wait $launcher
step run "$(tail -n 1 "$folder/summary")"
step replay "$("$bin/roci" replay --json "$folder/run")"
