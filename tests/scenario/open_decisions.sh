#!/usr/bin/env bash
# Flies a mission whose plans leave decisions to the ground, which answers the first one as nobody can, then well, then again, and the second one
# when it has been missed.
#   open_decisions.sh BIN_FOLDER MISSION DDS DOMAIN CHOICE
# Prints "step<TAB>exit code<TAB>last line" of each answer and closes with the step launch.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 choice=$5
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

console() {
  timeout 40 "$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain" "$@" --json
}

step() {  # name decision choice
  local output code
  output=$(console order answer "$2" "$3")
  code=$?
  printf '%s\t%s\t%s\n' "$1" $code "$(tail -n 1 <<<"$output")"
}

open() {  # the decisions that are asked now
  console decisions 2>/dev/null | grep -o '"id":"[^"]*"' | cut -d'"' -f4
}

other() {  # waits for one that is not this one
  local found=
  while [ -z "$found" ] && kill -0 $launcher 2>/dev/null; do
    found=$(open | grep -vxF -- "$1" | head -n 1)
  done
  echo "$found"
}

"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --speed 100 --headless --json --run-folder "$folder/run" \
  >"$folder/summary" 2>"$folder/errors" &
launcher=$!
first=$(other "")
step unknown "$first" nowhere
step taken "$first" "$choice"
step twice "$first" "$choice"
second=$(other "$first")
while open | grep -qxF -- "$second"; do :; done
step late "$second" "$choice"
wait $launcher
printf 'launch\t%s\t%s\n' $? "$(tail -n 1 "$folder/summary")"
cp "$folder/errors" /dev/stderr
