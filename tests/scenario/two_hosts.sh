#!/usr/bin/env bash
# Flies a mission on two hosts: planner and ground console on one, the rest on the other; a goal is sent across.
#   two_hosts.sh BIN_FOLDER MISSION DDS_OF_THE_ROBOT DDS_OF_THE_GROUND DOMAIN
# The hosts are network namespaces of its own, joined by a veth pair; no packet leaves them. Needs root.
# Prints the robot's summary as the last line; exits as the robot's launcher does, or as the ground's if that was well.
set -uo pipefail
bin=$1 mission=$2 robot_dds=$3 ground_dds=$4 domain=$5
robot=roci-robot-$$ ground=roci-ground-$$
folder=$(mktemp -d)
trap 'ip netns del $robot; ip netns del $ground; rm -rf "$folder"' EXIT

host() {  # namespace interface address
  ip -n "$1" addr add "$3/24" dev "$2"
  ip -n "$1" link set lo up
  ip -n "$1" link set "$2" up
}
ip netns add $robot 2>/dev/null || exit 77
set -e
ip netns add $ground
ip link add roci-r-$$ netns $robot type veth peer name roci-g-$$ netns $ground
host $robot roci-r-$$ 10.78.0.1
host $ground roci-g-$$ 10.78.0.2
for namespace in $robot $ground; do  # until the link is up on both sides, at most 1000 looks
  for _ in {1..1000}; do
    ip -n $namespace -br link show type veth | grep -q ' UP ' && break
  done
done
set +e

network=(--domain "$domain" --peers 10.78.0.1,10.78.0.2)
ip netns exec $robot timeout 60 "$bin/roci-launch" "$mission" --dds "$robot_dds" "${network[@]}" --address 10.78.0.1 \
  --services arm_svc,exec_svc,pathplan_svc,science_svc,sim_svc --speed 600 --headless --json --run-folder "$folder/robot" &
robot_launcher=$!
ip netns exec $ground timeout 60 "$bin/roci-launch" "$mission" --dds "$ground_dds" "${network[@]}" --address 10.78.0.2 \
  --services planner_svc --headless --run-folder "$folder/ground" >/dev/null &
ground_launcher=$!
ip netns exec $ground timeout 50 "$bin/roci" --dds "$ground_dds" "${network[@]}" --address 10.78.0.2 \
  goal add from-afar photo x=110 y=60 --class optional --utility 2 >&2 || echo "two_hosts: the goal did not get across" >&2
wait $robot_launcher || exit
wait $ground_launcher
