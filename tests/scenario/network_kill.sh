#!/usr/bin/env bash
# Flies a mission whose ground sends a network; when it is in force the planner dies.
#   network_kill.sh BIN_FOLDER MISSION DDS DOMAIN RUN_FOLDER NETWORK [DAMAGE]
# NETWORK: sent as n2. DAMAGE: a command that is run in the run folder before the kill. Prints "step<TAB>exit code<TAB>output" for the steps
# upload, killed, repeated (the same order again, to the next planner), status and launch.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 run=$5 network=$6 damage=${7:-true}

ask() {  # name arguments…: one call of roci
  local name=$1 output code
  shift
  output=$(timeout 40 "$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain" "$@" --json)
  code=$?
  printf '%s\t%s\t%s\n' "$name" $code "$(tail -n 1 <<<"$output")"
}

"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --speed 200 --headless --json --scenario ground \
  --run-folder "$run" >"$run.summary" &
launcher=$!
timeout 30 "$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain" events --count 1 >/dev/null
ask upload network upload "$network" --id n2
(cd "$run" && eval "$damage")
old=$(pgrep -P $launcher planner_svc)
kill -KILL "$old"
printf 'killed\t%s\ttrue\n' $?
for _ in $(seq 100); do
  new=$(pgrep -P $launcher planner_svc)
  [ -n "$new" ] && [ "$new" != "$old" ] && break
  sleep 0.1
done
ask repeated network upload "$network" --id n2
ask status network status
wait $launcher
printf 'launch\t%s\t%s\n' $? "$(tail -n 1 "$run.summary")"
rm -f "$run.summary"
