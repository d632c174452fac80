#!/usr/bin/env bash
# Flies a mission and asks the console for its first plan as it was executed, as soon as that has ended.
#   executed_plan.sh BIN_FOLDER MISSION DDS RUN_FOLDER [OPTION ...]
# Prints the plan as JSON in one line.
set -uo pipefail
bin=$1 mission=$2 dds=$3 run=$4
shift 4
"$bin/roci-launch" "$mission" --dds "$dds" --headless --json --run-folder "$run" "$@" >/dev/null &
launcher=$!
until "$bin/roci" executed 1 --json >"$run.executed" 2>/dev/null; do
  kill -0 $launcher 2>/dev/null || break
done
tr -d '\n' <"$run.executed"
rm -f "$run.executed"
kill -INT $launcher 2>/dev/null
wait $launcher
