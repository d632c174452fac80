#!/usr/bin/env bash
# Flies a mission and tells the resident memory of its planner and its executives each time that the robot has done something.
#   memory_in_flight.sh BIN_FOLDER MISSION DDS RUN_FOLDER [OPTION ...]
# Prints lines "SECONDS SERVICE KIB", SECONDS as effects.jsonl has them, then the summary.
set -uo pipefail
bin=$1 mission=$2 dds=$3 run=$4
shift 4
mkdir -m 700 "$run" && touch "$run/effects.jsonl"
"$bin/roci-launch" "$mission" --dds "$dds" --headless --json --run-folder "$run" "$@" >"$run.summary" &
launcher=$!
tail -n +1 -f --pid=$launcher "$run/effects.jsonl" | while IFS= read -r deed; do
  [[ $deed =~ \"time_us\":([0-9]+) ]] || continue
  seconds=$((BASH_REMATCH[1] / 1000000))
  for service in planner_svc exec_svc; do
    for process in $(pgrep -P $launcher "$service"); do
      kib=$(awk '/^VmRSS:/ { print $2 }' "/proc/$process/status" 2>/dev/null)
      [[ -n $kib ]] && echo "$seconds $service.$process $kib"
    done
  done
done
wait $launcher
tail -n 1 "$run.summary"
rm -f "$run.summary"
