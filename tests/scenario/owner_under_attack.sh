#!/usr/bin/env bash
# A live robot's service alone with an intruder in its executive's name, killed in between.
#   owner_under_attack.sh BIN_FOLDER TESTS_FOLDER MISSION DDS DOMAIN
# Prints what the intruder heard, the effects on the world as "effect JSON", and "end CODE".
set -uo pipefail
bin=$1 tests=$2 mission=$3 dds=$4 domain=$5
folder=$(mktemp -d)
trap 'kill -KILL $robot 2>/dev/null; rm -rf "$folder"' EXIT
export ROCI_PLUGIN_PATH=${bin%/bin}/lib/rocinante
epoch=$(date +%s)

robot() {  # incarnation
  "$bin/sim_svc" --run attacked --mission "$mission" --scenario nominal --run-folder "$folder" --dds "$dds" --domain "$domain" \
    --clock live --scale 20 --epoch "$epoch" --incarnation "$1" 2>"$folder/log" &
  robot=$!
}
intrude() {  # what to do is on standard input
  timeout 60 "$tests/intruder" "$dds" "$domain" attacked
}

robot 1
intrude <<LINES || exit 1
send execute sim_svc camera image p1.1-image 1 1 image=one
await 20 ack p1.1-image 1 accepted
send query sim_svc camera image x 1000000 1000000
await 20 ack x 1000000 unknown unknown-key newest 1
send execute sim_svc camera image p1.2-image 1000000 1000000 image=wide
await 20 ack p1.2-image 1000000 rejected epoch-jump newest 1
await 20 ack p1.1-image 1 completed
send execute sim_svc camera image p1.2-image 1 1 image=two
await 20 ack p1.2-image 1 accepted
as stranger
send execute sim_svc camera stow fallback.1.1.camera 9 9
await 20 ack fallback.1.1.camera 9 rejected not-leased
send execute sim_svc camera stop s1 0 0
await 20 ack p1.2-image 1 cancelled stopped
await 20 event sim_svc command.foreign stop (s1) of camera is taken from stranger
as exec_svc
send execute sim_svc camera image p1.3-image 1 1 image=three
await 20 ack p1.3-image 1 accepted
LINES
kill -KILL $robot
wait $robot 2>/dev/null
robot 2
intrude <<LINES || exit 1
send execute sim_svc camera image p1.1-image 1 1 image=one
await 20 ack p1.1-image 1 completed
send query sim_svc camera image p1.2-image 1 1
await 20 ack p1.2-image 1 cancelled
send query sim_svc camera image p1.3-image 1 1
await 20 ack p1.3-image 1 failed owner-restarted
send execute sim_svc camera image p1.3-image 1 1 image=three
await 20 ack p1.3-image 1 failed owner-restarted
send execute sim_svc camera image p1.4-image 0 0 image=four
await 20 ack p1.4-image 0 rejected old-epoch newest 1
LINES
sed 's/^/effect /' "$folder/effects.jsonl"
printf 'end 0\n'
