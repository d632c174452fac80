#!/usr/bin/env bash
# Flies the mission of example_service and kills its drill while it bores.
#   kill_drill.sh BIN_FOLDER MISSION DDS RUN_FOLDER OPTION ...
# Prints the summary.
set -uo pipefail
bin=$1 mission=$2 dds=$3 run=$4
shift 4
mkdir -m 700 "$run" && touch "$run/logbook.txt"
"$bin/roci-launch" "$mission" --dds "$dds" --headless --json --run-folder "$run" "$@" >"$run.summary" &
launcher=$!
timeout 60 tail -n +1 -f "$run/logbook.txt" | grep -q -m1 'drill_svc says accepted'
kill -KILL "$(pgrep -P $launcher drill_svc)"
wait $launcher
tail -n 1 "$run.summary"
