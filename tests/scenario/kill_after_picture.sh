#!/usr/bin/env bash
# Flies one photo on the live clock and kills the robot's service as soon as the picture is taken. The launcher starts it again.
#   kill_after_picture.sh BIN_FOLDER MISSION DDS DOMAIN
# Prints steps as ground_and_kills.sh does: "killed" (what the robot had done by then), "run" (the launcher's exit code and
# summary) and "effects" (what the robot did in all).
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4
folder=$(mktemp -d)
trap 'kill -KILL $launcher $(pgrep -P $launcher) 2>/dev/null; rm -rf "$folder"' EXIT

cp -r "$mission" "$folder/mission"
sed -i 's/open: \[\[.*\]\]/open: [[0, 14400]]/' "$folder/mission/mission.yaml"
cat >"$folder/mission/scenarios/one.yaml" <<'END'
description: One photo, close by.
duration_s: 3600
start: {x: 40, y: 40, heading: 0, arm: stow, battery: 900000}
science: {enabled: false}
stimuli:
  - {at_s: 5, goal: {issuer: ground, id: near, kind: photo, importance: hard, arguments: {x: 46, y: 42}}}
END

effects() {  # as one array
  printf '[%s]' "$(paste -sd, "$folder/run/effects.jsonl")"
}
step() {  # name exit_code output
  printf '%s\t%s\t%s\n' "$1" "$2" "$3"
}

"$bin/roci-launch" "$folder/mission" --scenario one --dds "$dds" --domain "$domain" --clock live --speed 40 \
  --headless --json --run-folder "$folder/run" >"$folder/summary" &
launcher=$!
until grep -qs '"kind":"image"' "$folder/run/effects.jsonl" || ! kill -0 $launcher 2>/dev/null; do sleep 0.02; done
kill -KILL "$(pgrep -P $launcher sim_svc)"
step killed 0 "$(effects)"
wait $launcher
step run $? "$(tail -n 1 "$folder/summary")"
step effects 0 "$(effects)"
