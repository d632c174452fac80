#!/usr/bin/env bash
# Flies a mission and asks the console how it stands when the first plan has ended; kills the executive then, and asks once more.
#   idle.sh BIN_FOLDER MISSION DDS DOMAIN RUN_FOLDER TIMELINE [OPTION ...]
# Prints the status at the first idling, the one of the executive that was started again as soon as it tells of TIMELINE, and the summary,
# each as JSON in one line.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 run=$5 timeline=$6
shift 6
roci=("$bin/roci" --dds "$dds" --domain "$domain")
"$bin/roci-launch" "$mission" --dds "$dds" --domain "$domain" --headless --json --run-folder "$run" "$@" >"$run.summary" &
launcher=$!
# Asks until all the texts stand in the answer.
status_with() {
  local status
  while kill -0 $launcher 2>/dev/null; do
    status=$("${roci[@]}" status --json 2>/dev/null)
    for text in "$@"; do [[ $status == *"$text"* ]] || continue 2; done
    break
  done
  tr -d '\n' <<<"$status"
  echo
}
status_with '"idle":'
kill -KILL "$(pgrep -P $launcher exec_svc)"
status_with '"idle":' "\"$timeline\":" '"incarnation":2'
wait $launcher
tail -n 1 "$run.summary"
rm -f "$run.summary"
