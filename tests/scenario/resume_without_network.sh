#!/usr/bin/env bash
# Flies a mission live in a network of its own, kills the launcher, takes the network away, goes on with --resume, and brings
# the network back once the launcher says that it waits for it.
#   unshare -rn resume_without_network.sh BIN_FOLDER MISSION DDS
# Prints steps as ground_and_kills.sh does: "waits" and "back" (what the launcher said), and "run" (its exit code and summary
# after SIGTERM). Exit code 77: there is no network to take away.
set -uo pipefail
bin=$1 mission=$2 dds=$3
folder=$(mktemp -d)
trap 'kill -KILL $launcher $(pgrep -P $launcher) 2>/dev/null; rm -rf "$folder"' EXIT
ip link set lo up || exit 77

until_file() {  # file text
  for _ in $(seq 600); do
    grep -aqs "$2" "$1" && return 0
    sleep 0.05
  done
  return 1
}
step() {  # name exit_code output
  printf '%s\t%s\t%s\n' "$1" "$2" "$3"
}

"$bin/roci-launch" "$mission" --dds "$dds" --clock live --speed 20 --headless --json --run-folder "$folder/run" >/dev/null 2>&1 &
launcher=$!
until_file "$folder/run/journal.sqlite-wal" goal.accepted
services=$(pgrep -P $launcher)
kill -KILL $launcher
wait $launcher 2>/dev/null
for service in $services; do while kill -0 "$service" 2>/dev/null; do sleep 0.02; done; done
ip link set lo down
"$bin/roci-launch" --resume "$folder/run" >"$folder/summary" 2>"$folder/said" &
launcher=$!
until_file "$folder/said" 'waits for its network'
step waits $? "\"$(grep -c 'waits for its network' "$folder/said")\""
ip link set lo up
until_file "$folder/said" 'its network is back'
step back $? "\"\""
kill -TERM $launcher
wait $launcher
step run $? "$(tail -n 1 "$folder/summary")"
