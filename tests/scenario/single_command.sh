#!/usr/bin/env bash
# Flies a mission in which nothing is asked for, and commands a component from the console.
#   single_command.sh BIN_FOLDER MISSION DDS DOMAIN RUN_FOLDER COMPONENT COMMAND [NAME=VALUE ...]
# Prints what the console prints as JSON, line by line, then its exit code.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 run=$5
shift 5
roci=("$bin/roci" --dds "$dds" --domain "$domain")
"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --headless --json --run-folder "$run" --scenario waiting --speed 30 >/dev/null &
launcher=$!
until "${roci[@]}" order autonomy E1 >/dev/null 2>&1; do
  kill -0 $launcher 2>/dev/null || break
done
"${roci[@]}" order command "$@" --json
echo $?
kill -INT $launcher 2>/dev/null
wait $launcher
