#!/usr/bin/env bash
# Asks the console what the planner of a flying mission expects of its plan, and ends the flight then.
#   lander_views.sh BIN_FOLDER MISSION DDS DOMAIN PICTURES
# Prints the last line of each step as "step<TAB>exit code<TAB>output"; pictures go to the folder PICTURES.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 pictures=$5
folder=$(mktemp -d)
roci=("$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain")
"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --speed 60 --headless --json --run-folder "$folder/run" \
  >"$folder/summary" 2>"$folder/errors" &
launcher=$!
trap 'kill -INT $launcher 2>/dev/null; wait $launcher; rm -rf "$folder"' EXIT

step() {  # name arguments…: one call of roci
  local name=$1 output code
  shift
  output=$(timeout 40 "${roci[@]}" "$@" 2>"$folder/told")
  code=$?
  printf '%s\t%s\t%s\n' "$name" $code "$(tail -n 1 <<<"$output")"
}

timeout 30 "${roci[@]}" events --count 1 >"$folder/first"
for _ in {1..20}; do  # the first plan comes a minute of mission time later
  timeout 40 "${roci[@]}" energy --json >/dev/null 2>&1 && break
done
for verb in downlinks utility energy subway chains; do
  step "$verb" "$verb" --json --svg "$pictures/$verb.svg"
  step "$verb-text" "$verb"
done
step nobody downlinks --robot nobody
printf 'nobody-told\t0\t"%s"\n' "$(tail -n 1 "$folder/told")"
step no-folder energy --svg "$folder/none/energy.svg"
