#!/usr/bin/env bash
# Flies a mission on two hosts, one service alone on the second, and takes the second one's cable out in flight, until a goal that is sent meanwhile
# has waited for it.
#   cut_service.sh BIN_FOLDER MISSION DDS DOMAIN SERVICE SPEED
# SERVICE: planner_svc or exec_svc. Flown live. The hosts are network namespaces of its own, on a bridge in a third; no packet leaves them. Needs root.
# Prints steps as ground_and_kills.sh does: flying (the status), add (a goal that is sent meanwhile to an executive that the planner is cut off from, or
# afterwards to one that was cut off itself), missed (0: the executive has told that it misses the other side, and the run goes on), robot and other
# (exit code and summary of each launcher) and effects (what the robot did).
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 service=$5 speed=$6
folder=$(mktemp -d)
declare -A address=([robot]=10.81.0.1 [other]=10.81.0.2)
. "$(dirname "$0")/hosts.sh"
trap 'remove_hosts; rm -rf "$folder"' EXIT
make_hosts

launch() {  # host services; in a subshell, whose place it takes
  exec ip netns exec roci-$1-$$ timeout 200 "$bin/roci-launch" "$mission" --dds "$dds" "${network[@]}" --address ${address[$1]} --services $2 --headless --json \
    --clock live --speed "$speed" --run-folder "$folder/$1" >"$folder/$1.summary" 2>"$folder/$1.log"
}
step() {  # name exit_code output
  printf '%s\t%s\t%s\n' "$1" "$2" "$3"
}
roci() {  # arguments…
  ip netns exec roci-$at-$$ timeout 60 "$bin/roci" --dds "$dds" "${network[@]}" --address ${address[$at]} "$@" --json
}
flying() { kill -0 $robot 2>/dev/null; }
until_said() {  # name pattern: waits until the executive's journal holds such an event, or the run is over
  while flying && ! grep -aqs "$2" "$folder/$executive"/journal.sqlite*; do read -r -t 0.1 <> <(:); done
  step "$1" "$(flying; echo $?)" '""'
}

all=arm_svc,exec_svc,pathplan_svc,planner_svc,science_svc,sim_svc
rest=${all/$service,/}
[[ $service == exec_svc ]] && executive=other || executive=robot
at=$executive
launch robot $rest &
robot=$!
launch other $service &
other=$!
while flying && status=$(roci status) && ! [[ $status =~ \"phase\":\"executing\" ]]; do :; done
step flying 0 "$status"
ip -n $net link set other down
if [[ $service == planner_svc ]]; then
  step add $? "$(roci goal add more photo x=60 y=45)"
  until_said missed plan.retry
else
  until_said missed 'service.lost sim_svc'
fi
ip -n $net link set other up
[[ $service == exec_svc ]] && step add $? "$(roci goal add more photo x=60 y=45)"
wait $robot
step robot $? "$(tail -n 1 "$folder/robot.summary")"
kill -TERM $other 2>/dev/null  # in a live run nobody else ends it
wait $other
step other $? "$(tail -n 1 "$folder/other.summary")"
step effects 0 "[$(paste -sd , "$folder/robot/effects.jsonl")]"
