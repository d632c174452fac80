#!/usr/bin/env bash
# Asks the console of a flying mission for its subway map until a sample's outcome stands in it, and ends the flight then.
#   subway_view.sh BIN_FOLDER MISSION SCENARIO DDS DOMAIN PICTURE
# Prints the last line of each step as "step<TAB>exit code<TAB>output".
set -uo pipefail
bin=$1 mission=$2 scenario=$3 dds=$4 domain=$5 picture=$6
folder=$(mktemp -d)
roci=("$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain")
"$bin/roci-launch" "$mission" --scenario "$scenario" --dds "$dds" --domain "$domain" --speed 20000 --headless --json \
  --run-folder "$folder/run" >"$folder/summary" 2>"$folder/errors" &
launcher=$!
trap 'kill -INT $launcher 2>/dev/null; wait $launcher; rm -rf "$folder"' EXIT

timeout 30 "${roci[@]}" events --count 1 >"$folder/first"
while kill -0 "$launcher" 2>/dev/null; do
  output=$(timeout 40 "${roci[@]}" subway --json --svg "$picture" 2>/dev/null)
  code=$?
  grep -qE '"outcome": ?"(negative|positive)"' <<<"$output" && break
done
printf 'subway\t%s\t%s\n' $code "$(tail -n 1 <<<"$output")"
text=$(timeout 40 "${roci[@]}" subway 2>"$folder/told")
printf 'subway-text\t%s\t%s\n' $? "$(python3 -c 'import json, sys; print(json.dumps(sys.stdin.read()))' <<<"$text")"
