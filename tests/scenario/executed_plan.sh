#!/usr/bin/env bash
# Flies a mission and asks the console for its first plan as it was executed, as soon as that has ended.
#   executed_plan.sh BIN_FOLDER MISSION DDS DOMAIN RUN_FOLDER [OPTION ...]
# Prints the plan as JSON in one line.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 run=$5
shift 5
roci=("$bin/roci" --dds "$dds" --domain "$domain")
"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --headless --json --run-folder "$run" "$@" >/dev/null &
launcher=$!
until "${roci[@]}" executed 1 --json >"$run.executed" 2>/dev/null; do
  kill -0 $launcher 2>/dev/null || break
done
tr -d '\n' <"$run.executed"
rm -f "$run.executed"
kill -INT $launcher 2>/dev/null
wait $launcher
