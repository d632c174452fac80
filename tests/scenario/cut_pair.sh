#!/usr/bin/env bash
# Flies a mission on three hosts, the pair of executives on one each, and cuts them off in flight.
#   cut_pair.sh BIN_FOLDER MISSION DDS DOMAIN CUT CLOCK SPEED
# CUT: between (the two do not hear each other), first (its cable is out), leader (the switch of the first is silent), second (its),
# robot (the first executive and the robot do not hear each other, which the second one does), handover (the same, and the first one
# is killed as soon as it begins to hand over), merging (as leader, and the second one dies when the first hands over what it has acknowledged meanwhile).
# The hosts are network namespaces of its own, on a bridge in a fourth; no packet leaves them. Needs root.
# Prints steps as ground_and_kills.sh does: flying, cut (the pair as the robot's host sees it), add (a goal sent
# meanwhile), recall (of goal depot, with CUT leader or merging, from the host that is cut off), hold (an order, with CUT leader, from there), healed, ended (goals as they are in the
# end), lost (how often the first executive says that the order is not in force), and, when all is ended, robot, first, second (exit code and summary of each launcher), effects (what the robot did) and
# led (how often each executive began to lead).
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 cut=$5 clock=$6 speed=$7
folder=$(mktemp -d)
declare -A address=([robot]=10.79.0.1 [first]=10.79.0.2 [second]=10.79.0.3)
. "$(dirname "$0")/hosts.sh"
trap 'remove_hosts; rm -rf "$folder"' EXIT
make_hosts

on() {  # host command…
  ip netns exec roci-$1-$$ timeout 100 "${@:2}"
}
launch() {  # host services options…; in a subshell, whose place it takes
  exec ip netns exec roci-$1-$$ timeout 250 "$bin/roci-launch" "$mission" --dds "$(vendor $1)" "${network[@]}" --address ${address[$1]} --services $2 --headless --json \
    --clock $clock --speed $speed --run-folder "$folder/$1" "${@:3}" >"$folder/$1.summary" 2>"$folder/$1.log"
}
vendor() {  # host
  [[ $dds == mixed && $1 == second ]] && echo cyclonedds || echo "${dds/mixed/fastdds}"
}
step() {  # name exit_code output
  printf '%s\t%s\t%s\n' "$1" "$2" "$3"
}
roci() {  # host arguments…
  on $1 "$bin/roci" --dds "$(vendor $1)" "${network[@]}" --address ${address[$1]} "${@:2}" --json
}
until_status() {  # name host pattern: asks there until the status shows it, or the run is over
  local status=""
  while kill -0 $robot 2>/dev/null; do
    status=$(roci $2 status)
    [[ $status =~ $3 ]] && break
  done
  step "$1" 0 "$status"
}
until_log() {  # host text: waits until its executive says it, or the run is over
  grep -qm1 "$2" < <(tail -q -n +1 -F --pid=$robot "$folder/$1"/exec_svc*.log 2>/dev/null)
}
part() {  # CUT on|off
  case $1 in
    between) for port in first second; do bridge -n $net link set dev $port isolated $2; done ;;
    robot | handover) for port in first robot; do bridge -n $net link set dev $port isolated $2; done ;;
    first) ip -n $net link set first "$([[ $2 == on ]] && echo down || echo up)" ;;
    leader | merging) bridge -n $net link set dev first state "$([[ $2 == on ]] && echo 0 || echo 3)" ;;
    second) bridge -n $net link set dev second state "$([[ $2 == on ]] && echo 0 || echo 3)" ;;
  esac
}

executive_of() {  # launcher: the process
  pgrep -P "$(pgrep -P $1 roci-launch || echo $1)" exec_svc
}

launch robot arm_svc,pathplan_svc,planner_svc,science_svc,sim_svc &
robot=$!
launch first exec_svc --standby &
first=$!
[[ $cut == merging ]] && export ROCI_CRASH=,after-hand-over:1  # it leads in epoch 2
launch second exec_svc.standby --standby &
second=$!
until_status flying robot '"leader":"first".*"standby_ready":true.*"phase":"executing"'
served=$(executive_of $second)
part $cut on
case $cut in
  between) until_status cut robot '"leader":"first".*"standby_ready":false' ;;
  second)
    until_status cut robot '"leader":"first".*"standby_ready":false'
    until_log second 'would lead, since it heard nobody for'  # and does not: nobody grants it a lease
    ;;
  handover)
    until_log first 'stands down: it lacks'
    kill -KILL "$(executive_of $first)"
    until_status cut robot '"leader":"second"'
    ;;
  *) until_status cut robot '"leader":"second"' ;;
esac
step add $? "$(roci robot goal add more photo x=60 y=45)"
ended='("state":"achieved".*){4}'
if [[ $cut == leader || $cut == merging ]]; then
  recalled=$(roci first goal cancel depot)
  step recall $? "$recalled"
  [[ $cut == leader ]] && step hold $? "$(roci first order hold --id held)"
  ended='"id":"depot"[^}]*"state":"recalled"'
fi
part $cut off
until_status healed robot '"standby_ready":true'
until_status ended robot "$ended"
if [[ $cut == leader ]]; then
  until_log first 'order ground/held (hold) was taken'
  step lost 0 "$(grep -ch 'order ground/held (hold) was taken' "$folder"/first/exec_svc*.log)"
fi
[[ $cut == merging ]] && step died 0 "[$(executive_of $second), $served]"
kill -TERM $robot $first $second 2>/dev/null
for host in robot first second; do
  wait ${!host}
  step $host $? "$(tail -n 1 "$folder/$host.summary")"
done
step effects 0 "[$(paste -sd , "$folder/robot/effects.jsonl")]"
for host in first second; do grep -c 'leads in epoch' "$folder/$host"/exec_svc*.log; done |
  paste -sd , | { read -r counts; step led 0 "[$counts]"; }
