#!/usr/bin/env bash
# Watches two rovers from the ground until a repair has ended, and ends the flight then.
#   rovers_views.sh BIN_FOLDER MISSION DDS DOMAIN FOLDER SCENARIO SPEED
# Prints the lines of `roci watch --json`, and between them "step<TAB>exit code<TAB>output" of what is asked for while the repair is
# under way. The watcher is there before the mission, so that it hears every command.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 folder=$5 scenario=$6 speed=$7
roci=("$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain")
exec 3< <(exec timeout 200 "${roci[@]}" watch --json 2>"$folder/watcher")
watcher=$!
IFS= read -r -u3 _
"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --scenario "$scenario" --speed "$speed" --headless --json \
  --run-folder "$folder/run" >"$folder/summary" 2>"$folder/errors" 3<&- &
launcher=$!
trap 'kill -INT $launcher $watcher 2>/dev/null; wait' EXIT

ask() {
  local output
  for verb in plan status; do
    output=$(timeout 40 "${roci[@]}" "$verb" --json)
    printf '%s\t%s\t%s\n' "$verb" $? "$output"
  done
  output=$(timeout 40 "${roci[@]}" status)
  printf 'text\t%s\t"%s"\n' $? "$(tr '\n' ';' <<<"$output")"
  output=$(timeout 60 "${roci[@]}" map --json --mission "$mission" --svg "$folder/now.svg")
  printf 'map\t%s\t%s\n' $? "$output"
}

asked=0
while IFS= read -r -u3 line; do
  printf '%s\n' "$line"
  if ((!asked)) && [[ $line == *'"under way"'* ]]; then
    ask
    asked=1
  fi
  [[ $line != *'"mended"'* ]] || break
done
