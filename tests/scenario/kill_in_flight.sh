#!/usr/bin/env bash
# Flies a mission and kills one of its services when the robot has done something to an object for the first time.
#   kill_in_flight.sh BIN_FOLDER MISSION DDS RUN_FOLDER SERVICE OBJECT [OPTION ...]
# OBJECT as effects.jsonl names it. Prints "killed SERVICE" if it was there, then the summary.
set -uo pipefail
bin=$1 mission=$2 dds=$3 run=$4 service=$5 object=$6
shift 6
mkdir -m 700 "$run" && touch "$run/effects.jsonl"
"$bin/roci-launch" "$mission" --dds "$dds" --headless --json --run-folder "$run" "$@" >"$run.summary" &
launcher=$!
timeout 60 tail -n +1 -f "$run/effects.jsonl" | grep -q -m1 "\"object\":\"$object\""
# By its program's name, else by a part of its command line: several services may run one program.
process=$(pgrep -P $launcher "$service" || pgrep -f -P $launcher "$service")
kill -KILL "$process" && echo "killed $service"
wait $launcher
tail -n 1 "$run.summary"
rm -f "$run.summary"
