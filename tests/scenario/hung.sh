#!/usr/bin/env bash
# Flies a mission and makes processes of it hang (SIGSTOP) or kills them, all in the same moment of the flight.
#   hung.sh BIN_FOLDER MISSION DDS DOMAIN RETURNING LOST KILLED [launcher's options…]
# RETURNING: services, separated by commas, that go on (SIGCONT) when the others have given them up; LOST: those that
# never go on by themselves; KILLED: those that are killed. A goal is sent meanwhile. A console hangs from then on to the end.
# Prints steps as ground_and_kills.sh does: flying and given-up (the status), add (the goal), heard (the status with the
# RETURNING again), replaced (0: the processes of LOST and KILLED are gone), launch (exit code and summary), effects (what
# the robot did), replay.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 returning=${5//,/ } lost=${6//,/ } killed=${7//,/ }
folder=$(mktemp -d)
trap 'kill -KILL $launcher $watcher $(pgrep -P $launcher) 2>/dev/null; rm -rf "$folder"' EXIT

roci=("$bin/roci" --dds "${dds/mixed/cyclonedds}" --domain "$domain")
step() {  # name exit_code output
  printf '%s\t%s\t%s\n' "$1" "$2" "$3"
}
until_status() {  # name test…: asks until the test holds for the status, or the run is over
  local name=$1 status=""
  shift
  while kill -0 $launcher 2>/dev/null; do
    status=$(timeout 40 "${roci[@]}" status --json)
    "$@" "$status" && break
  done
  step "$name" 0 "$status"
}
executing() { [[ $1 == *'"phase":"executing"'* ]]; }
all_heard() {  # services status
  for service in $1; do [[ $2 == *"\"name\":\"$service\""* ]] || return 1; done
}
none_heard() {  # services status
  for service in $1; do [[ $2 != *"\"name\":\"$service\""* ]] || return 1; done
}
processes() {  # services
  for service in $1; do pgrep -P $launcher -x "$service"; done
}

"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --headless --json --run-folder "$folder/run" "${@:8}" \
  >"$folder/summary" 2>"$folder/errors" &
launcher=$!
"${roci[@]}" watch --json >/dev/null 2>&1 &
watcher=$!
until_status flying executing
going=$(processes "$returning")
gone=$(processes "$lost $killed")
kill -STOP $watcher
for process in $going $(processes "$lost"); do kill -STOP $process; done
for process in $(processes "$killed"); do kill -KILL $process; done
if [[ $lost != sim_svc ]]; then  # else it is the end of the run
  timeout 40 "${roci[@]}" goal add more photo x=110 y=100 --json >"$folder/add" &
  adding=$!
fi
if [[ -n $going ]]; then
  until_status given-up none_heard "$returning"
  for process in $going; do kill -CONT $process; done
  until_status heard all_heard "$returning"
fi
replaced=0
for process in $gone; do timeout 30 tail -s 0.1 --pid=$process -f /dev/null || replaced=$?; done
step replaced $replaced '{}'
[[ -v adding ]] && wait $adding
step add $? "$(cat "$folder/add" 2>/dev/null)"
wait $launcher
step launch $? "$(tail -n 1 "$folder/summary")"
step effects 0 "[$(paste -sd , "$folder/run/effects.jsonl")]"
journal=$(sed -n 's/.*"journal":"\([^"]*\)".*/\1/p' "$folder/summary")
step replay 0 "$("$bin/roci" replay --json "$folder/run/$journal")"
cat "$folder/errors" >&2
