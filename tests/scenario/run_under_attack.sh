#!/usr/bin/env bash
# A short live mission on whose domain others start a run, a second launcher of the same run, a second executive and a second simulator; somebody tells of
# the robot and acknowledges commands as if it were his; an intruder asks in the executive's name in far epochs, forges heartbeats and repeats every command;
# and the executive loses its journal in flight.
#   run_under_attack.sh BIN_FOLDER TESTS_FOLDER MISSION DDS DOMAIN
# Prints "step<TAB>exit code<TAB>what it printed" for each of them, effects as "effect JSON", and the step launch.
set -uo pipefail
bin=$1 tests=$2 mission=$3 dds=$4 domain=$5
folder=$(mktemp -d)
trap 'kill -KILL $(jobs -p) $launcher $(pgrep -P $launcher) 2>/dev/null; rm -rf "$folder"' EXIT
export ROCI_PLUGIN_PATH=${bin%/bin}/lib/rocinante
vendor=${dds/mixed/fastdds}

cp -r "$mission" "$folder/mission"
cat >"$folder/mission/scenarios/short.yaml" <<YAML
description: Two images, a short drive apart.
duration_s: 14400
start: {x: 40, y: 40, heading: 0, arm: stow, battery: 900000}
world: {slip: 0.04, image_noise: 0.02}
science: {enabled: false}
stimuli:
  - {at_s: 10, goal: {issuer: ground, id: ridge, kind: photo, importance: hard, arguments: {x: 60, y: 44}}}
  - {at_s: 10, goal: {issuer: ground, id: crest, kind: photo, importance: hard, arguments: {x: 52, y: 56}}}
YAML
step() {  # name exit-code file
  printf '%s\t%s\t%s\n' "$1" "$2" "$(tr '\n\t' '  ' <"$3")"
}
launch() {  # run folder more…
  exec timeout 100 "$bin/roci-launch" "$folder/mission" --scenario short --dds "$dds" --domain "$domain" --run "$1" \
    --clock live --speed 40 --headless --json --run-folder "$folder/$2" "${@:3}" >"$folder/$2.out" 2>&1
}
until_there() {  # file pattern
  for _ in $(seq 400); do
    grep -qs "$2" "$1" && return
    read -r -t 0.05 <> <(:)
  done
}

"$tests/intruder" "$vendor" "$domain" attacked >"$folder/heard.out" 2>&1 <<<"await 100 scenario.over" &
launch attacked run &
launching=$!
until_there "$folder/run/effects.jsonl" motion
launcher=$(pgrep -P $launching roci-launch)
(launch another other); step another-run $? "$folder/other.out"
(launch attacked twin); step same-run $? "$folder/twin.out"
mkdir "$folder/lone"
timeout 60 "$bin/exec_svc" --run attacked --robot rover --mission "$folder/mission" --scenario short --run-folder "$folder/lone" \
  --dds "$vendor" --domain "$domain" --clock live --scale 40 --epoch "$(date +%s)" --incarnation 1 >"$folder/lone.out" 2>&1
step second-executive $? "$folder/lone.out"
mkdir "$folder/double"
timeout 60 "$bin/sim_svc" --run attacked --mission "$folder/mission" --scenario short --run-folder "$folder/double" \
  --dds "$vendor" --domain "$domain" --clock live --scale 40 --epoch "$(date +%s)" --incarnation 1 >"$folder/double.out" 2>&1
step second-simulator $? "$folder/double.out"
timeout 60 "$tests/intruder" "$vendor" "$domain" attacked >"$folder/owner.out" 2>&1 <<LINES
as double
observe rover.nav idle-at nowhere
await 20 event exec_svc timeline.contested
acknowledge sim_svc p1.1-drive 1
await 20 event exec_svc ack.foreign
LINES
step second-owner $? "$folder/owner.out"
timeout 60 "$tests/intruder" "$vendor" "$domain" attacked >"$folder/intruder.out" 2>&1 <<LINES
send query sim_svc nav drive x 1000000 1000000
send execute sim_svc nav drive y 1000000 1000000
beat sim_svc 4000000000 1
beat exec_svc 4000000000 1
stop sim_svc 1 2
repeat 1.5
LINES
step intruder $? "$folder/intruder.out"
executive=$(pgrep -P "$launcher" exec_svc)
kill -STOP "$executive"
rm -f "$folder"/run/journal.sqlite*
kill -KILL "$executive"
wait $launching
code=$?
sed 's/^/effect /' "$folder/run/effects.jsonl"
step events 0 "$folder/heard.out"
printf 'launch\t%s\t%s\n' $code "$(tail -n 1 "$folder/run.out")"
