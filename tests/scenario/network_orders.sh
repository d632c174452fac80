#!/usr/bin/env bash
# Flies a mission whose ground replaces the network, sets parameters of it and values of timelines.
#   network_orders.sh BIN_FOLDER MISSION DDS DOMAIN
# Prints the last line of each step as "step<TAB>exit code<TAB>output" and closes with the step launch.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

step() {  # name arguments…: one call of roci
  local name=$1 output code
  shift
  output=$(timeout 40 "$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain" "$@" --json)
  code=$?
  printf '%s\t%s\t%s\n' "$name" $code "$(tail -n 1 <<<"$output")"
}

"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --speed 300 --headless --json --scenario ground \
  --run-folder "$folder/run" >"$folder/summary" &
launcher=$!
timeout 30 "$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain" events --count 1 >"$folder/first"
step upload network upload "$mission/changed.yaml" --id n2
step stale network upload "$mission/network.yaml" --id old
step broken network upload "$mission/broken.yaml"
step repeated network upload "$mission/changed.yaml" --id n2
step set network set dig_s_far 1000 --id far
step out-of-range network set dig_s_far 9000 --id too-long
step status network status
step value order set lander.go go
wait $launcher
printf 'launch\t%s\t%s\n' $? "$(tail -n 1 "$folder/summary")"
