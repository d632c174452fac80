#!/usr/bin/env bash
# Flies a mission, asks for its plan when something was learned, kills the planner, and asks for the plan of the next one.
#   learning_kill.sh BIN_FOLDER MISSION DDS DOMAIN RUN_FOLDER LEARNED
# LEARNED: what a plan in JSON has in it once that is so. Prints "step<TAB>exit code<TAB>output" for the steps first (the plan at the
# beginning), before, killed, after and launch.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 run=$5 learned=$6

ask() { timeout 40 "$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain" "$@" --json | tail -n 1; }
tell() { printf '%s\t%s\t%s\n' "$1" "$2" "$3"; }
version_of() { grep -o '"version":[0-9]*' <<<"$1" | head -n 1 | cut -d : -f 2; }

"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --speed 300 --headless --json --scenario learning \
  --run-folder "$run" >"$run.summary" &
launcher=$!
for _ in $(seq 60); do
  plan=$(ask plan)
  grep -q '"activities"' <<<"$plan" && break
done
tell first 0 "$plan"
for _ in $(seq 60); do
  grep -qF "$learned" <<<"$plan" && break
  plan=$(ask plan)
done
tell before 0 "$plan"
kill -KILL "$(pgrep -P $launcher planner_svc)"
tell killed $? true
version=$(version_of "$plan")
for _ in $(seq 60); do
  plan=$(ask plan)
  [ "$(version_of "$plan")" -gt "$version" ] && break
done
tell after 0 "$plan"
wait $launcher
tell launch $? "$(tail -n 1 "$run.summary")"
rm -f "$run.summary"
