#!/usr/bin/env bash
# Flies the two rovers on three hosts: the ground with world and planner, the primary with the executive, and the scout.
#   faster_hosts.sh BIN_FOLDER MISSION DDS DOMAIN FOLDER CLOCK SPEED [CUT_AT CUT_S|dead AT|planner HOST|refused]
# DDS mixed: the rovers are on different vendors. The hosts are network namespaces of their own, on a bridge in a fourth; they speak to the hosts
# of the run alone (--peers), and no packet leaves them. Needs root.
# CUT_AT CUT_S: as soon as the scout drives to way-point CUT_AT the link between the rovers is down, for CUT_S seconds of mission time; both hear the ground.
# dead AT: as soon as the scout drives to way-point AT all that runs on its host is killed, and nobody starts it again; what the ground is told from then on
# stands in FOLDER/told. The step dead comes with the mission time then. planner HOST: the planner runs there instead of on the ground.
# refused: the scout is first started without its vendor's transport, and in flight the ground starts a scout.locomotion of its own; what their launchers say
# stands in FOLDER/bare.said and FOLDER/second.said, and the steps bare and second come with their exit codes.
# Each host has its run folder in FOLDER, which must be there. Prints "step<TAB>exit code<TAB>output" for the steps heard and, with a cut, cut and healed (mission
# time in s, as the ground is told), then ground, primary and scout (their launchers' summaries).
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 folder=$5 clock=$6 speed=$7 cut_at=${8:-} cut_s=${9:-0} planner=ground
case $cut_at in dead) cut_at= dead_at=$9 ;; planner) cut_at= planner=$9 ;; esac
declare -A address=([ground]=10.81.0.1 [primary]=10.81.0.2 [scout]=10.81.0.3)
declare -A services=(
  [ground]=sim_svc
  [primary]=exec_svc,communications,primary.path,primary.path_planning,primary.locomotion
  [scout]=scout.path,scout.path_planning,scout.locomotion
)
services[$planner]+=,planner_svc
. "$(dirname "$0")/hosts.sh"
trap 'remove_hosts' EXIT
make_hosts

vendor() {  # host
  [[ $dds == mixed && $1 != primary ]] && echo cyclonedds || echo "${dds/mixed/fastdds}"
}
launch() {  # host services name; in a subshell, whose place it takes
  exec ip netns exec roci-$1-$$ timeout 250 "$bin/roci-launch" "$mission" --dds "$(vendor $1)" "${network[@]}" --address ${address[$1]} \
    --services $2 --scenario trial --headless --json --clock "$clock" --speed "$speed" --run-folder "$folder/$3" >"$folder/$3.summary"
}
refused() {  # name host services bin: what its launcher says before it ends
  (bin=$4 && launch $2 $3 $1) 2>"$folder/$1.said"
  printf '%s\t%s\tnull\n' $1 $?
}
roci() {  # arguments…: on the ground's host
  ip netns exec roci-ground-$$ timeout 100 "$bin/roci" --dds "$(vendor ground)" "${network[@]}" --address ${address[ground]} "$@" --json
}
part() { for port in primary scout; do bridge -n $net link set dev $port isolated $1; done; }  # on|off
now() { roci status | tail -n 1 | grep -o '"time_s":[0-9]*' | head -n 1 | cut -d: -f2; }        # mission time
until_driving() {  # AT; or the ground's launcher has ended
  tail --pid=$ground -n +1 -F "$folder/ground/effects.jsonl" 2>/dev/null | grep -q -m1 "\"commander\":\"scout.locomotion\".*\"object\":\"$1\""
}
processes() {  # PID: it and all below it, itself first, so that nobody starts again what is killed
  local child
  echo $1
  for child in $(pgrep -P $1); do processes $child; done
}
flying() { kill -0 $ground 2>/dev/null; }

if [[ $cut_at == refused ]]; then
  mkdir -p "$folder/without/bin" "$folder/without/lib/rocinante"
  cp "$bin"/{roci-launch,dedicated_svc,pathplan_svc} "$folder/without/bin"
  cp "$bin"/../lib/rocinante/*"$(vendor primary)"* "$folder/without/lib/rocinante"
  refused bare scout ${services[scout]} "$folder/without/bin"
fi
roci events --count 1 >"$folder/heard" &
heard=$!
for host in ground primary scout; do
  launch $host ${services[$host]} $host &
  declare $host=$!
done
wait $heard
printf 'heard\t%s\t%s\n' $? "$(tail -n 1 "$folder/heard")"
if [[ $cut_at == refused ]]; then
  refused second ground scout.locomotion "$bin"
elif [[ -n ${dead_at:-} ]]; then
  roci events >"$folder/told" &
  until_driving $dead_at
  kill -KILL $(processes $scout)
  printf 'dead\t0\t%s\n' "$(now)"
elif [[ -n $cut_at ]]; then
  until_driving $cut_at
  part on
  begun=$(now)
  printf 'cut\t0\t%s\n' "${begun:-null}"
  while flying && time=$(now) && [[ ${time:-0} -lt $((begun + cut_s)) ]]; do :; done
  part off
  printf 'healed\t0\t%s\n' "${time:-null}"
fi
wait $ground
code=$?
[[ $clock == live ]] && kill -TERM $primary $scout  # whoever lives on does not end with the world
for host in ground primary scout; do
  [[ $host == ground ]] || { wait ${!host}; code=$?; }
  printf '%s\t%s\t%s\n' $host $code "$(tail -n 1 "$folder/$host.summary")"
done
