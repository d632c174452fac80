#!/usr/bin/env bash
# Flies a mission of a task network on three hosts: the lander, its planner and its ground on one each.
#   lander_hosts.sh BIN_FOLDER MISSION DDS DOMAIN SCENARIO SPEED [NETWORK]
# The ground waits until it hears the flight, and with NETWORK sends that as n2. The hosts are network namespaces of their own, on a bridge in a
# fourth; they speak to the hosts of the run alone (--peers), and no packet leaves them. Needs root.
# Prints "step<TAB>exit code<TAB>output" for the steps heard, upload, status, lander (its launcher's summary) and planner.
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 scenario=$5 speed=$6 network_file=${7:-}
folder=$(mktemp -d)
declare -A address=([lander]=10.80.0.1 [planner]=10.80.0.2 [ground]=10.80.0.3)
. "$(dirname "$0")/hosts.sh"
trap 'remove_hosts; rm -rf "$folder"' EXIT
make_hosts

vendor() {  # host
  [[ $dds == mixed && $1 != lander ]] && echo cyclonedds || echo "${dds/mixed/fastdds}"
}
launch() {  # host services options…; in a subshell, whose place it takes
  exec ip netns exec roci-$1-$$ timeout 250 "$bin/roci-launch" "$mission" --dds "$(vendor $1)" "${network[@]}" --address ${address[$1]} \
    --services $2 --scenario "$scenario" --headless --json --speed "$speed" --run-folder "$folder/$1" >"$folder/$1.summary"
}
ask() {  # name arguments…: one call of roci, on the ground's host
  local name=$1 output code
  shift
  output=$(ip netns exec roci-ground-$$ timeout 100 "$bin/roci" --dds "$(vendor ground)" "${network[@]}" --address ${address[ground]} "$@" --json)
  code=$?
  printf '%s\t%s\t%s\n' "$name" $code "$(tail -n 1 <<<"$output")"
}

ask heard events --count 1 &
heard=$!
launch planner planner_svc &
planner=$!
launch lander exec_svc,sim_svc &
lander=$!
wait $heard
if [[ -n $network_file ]]; then
  ask upload network upload "$network_file" --id n2
  ask status network status
fi
for host in lander planner; do
  wait ${!host}
  printf '%s\t%s\t%s\n' $host $? "$(tail -n 1 "$folder/$host.summary")"
done
