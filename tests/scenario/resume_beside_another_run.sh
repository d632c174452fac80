#!/usr/bin/env bash
# Flies a mission live on a given domain, kills the launcher, lets another run have the domain, and goes on with --resume.
#   resume_beside_another_run.sh BIN_FOLDER MISSION DDS DOMAIN
# Prints steps as ground_and_kills.sh does: "fresh" (exit code and last words of a run that is begun beside the other), three
# of a --resume that is refused ("another_clock", "another_scenario", and "damaged", on a launch.json that is so), and "run"
# (exit code of the resumed launcher after SIGTERM, once it has started its executive; its summary).
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4
folder=$(mktemp -d)
trap 'kill -KILL $launcher $other $(pgrep -P $launcher) $(pgrep -P $other) 2>/dev/null; rm -rf "$folder"' EXIT

until_so() {  # command that succeeds once it is so
  for _ in $(seq 600); do
    "$@" && return 0
    read -r -t 0.05 <> <(:)
  done
  return 1
}
step() {  # name exit_code output
  printf '%s\t%s\t%s\n' "$1" "$2" "$3"
}
launch() {  # run more…
  exec "$bin/roci-launch" "$mission" --dds "$dds" --clock live --speed 20 --headless --json --domain "$domain" --run "$1" \
    --run-folder "$folder/$1" "${@:2}" >"$folder/$1.out" 2>&1
}

launch mine &
launcher=$!
until_so grep -aqs goal.accepted "$folder/mine/journal.sqlite-wal"
services=$(pgrep -P $launcher)
kill -KILL $launcher
wait $launcher 2>/dev/null
for service in $services; do until_so eval "! kill -0 $service 2>/dev/null"; done
launch other &
other=$!
until_so grep -aqs goal.accepted "$folder/other/journal.sqlite-wal"
(launch third)
step fresh $? "\"$(tail -n 1 "$folder/third.out" | tr -d '"')\""
refused() {  # name options…
  "$bin/roci-launch" --resume "$folder/mine" "${@:2}" >"$folder/refused" 2>&1
  step "$1" $? "\"$(tail -n 1 "$folder/refused" | tr -d '"')\""
}
refused another_clock --clock simulated
refused another_scenario --scenario arm_stuck
cp "$folder/mine/launch.json" "$folder/whole.json"
sed -i 's/"format": 1/"format": "x"/' "$folder/mine/launch.json"
refused damaged
cp "$folder/whole.json" "$folder/mine/launch.json"
"$bin/roci-launch" --resume "$folder/mine" >"$folder/summary" 2>"$folder/said" &
launcher=$!
until_so eval "pgrep -P $launcher exec_svc >/dev/null || ! kill -0 $launcher 2>/dev/null"
kill -TERM $launcher
wait $launcher
step run $? "$(tail -n 1 "$folder/summary")"
