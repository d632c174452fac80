#!/usr/bin/env bash
# Flies a mission, speaks to it as its ground with `roci … --json`, and kills one service after the other in flight.
#   ground_and_kills.sh BIN_FOLDER MISSION DDS DOMAIN
# Prints what each step printed as "step<TAB>exit code<TAB>output" and closes with the step launch: the launcher's
# exit code and summary. The steps kill-… have no output; their code is that of the kill.
#
# The speed: each roci joins the run anew, which takes wall time, and ten of them come before the last kill. At 1000, the first
# speed of this script, the mission was over by then once plans had become shorter, and again at 400; no speed changes what a kill
# does on the simulated clock. A kill that finds the mission over fails the test, so that too high a speed shows.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

step() {  # name arguments…: one call of roci
  local name=$1 output
  shift
  output=$(timeout 40 "$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain" "$@" --json)
  printf '%s\t%s\t%s\n' "$name" $? "$output"
}

"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --speed 200 --headless --json \
  --run-folder "$folder/run" >"$folder/summary" &
launcher=$!
step add goal add more photo x=110 y=100
step refused goal add bad photograph x=1
step cancel-unknown goal cancel nothing
step add-second goal add second photo x=60 y=60
step cancel goal cancel second
step list goal list
for service in exec_svc planner_svc arm_svc pathplan_svc; do
  kill -KILL "$(pgrep -P $launcher "$service")" 2>/dev/null
  printf 'kill-%s\t%s\tnull\n' "$service" $?
  step "event-after-$service" events --count 1
done
step status status
step plan plan
wait $launcher
printf 'launch\t%s\t%s\n' $? "$(tail -n 1 "$folder/summary")"
