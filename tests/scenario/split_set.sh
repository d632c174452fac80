#!/usr/bin/env bash
# Flies a convoy on five hosts and cuts them so that each executive of the pair hears a part of the owners of commands alone.
#   split_set.sh BIN_FOLDER MISSION DDS DOMAIN SPEED
# The hosts: world (sim_svc, the planner), scout and primary (the dedicated executive of each rover), first and second (an executive each). While it is cut,
# first hears scout and nobody else, and second hears all but scout and first. It is cut when the scout does its first command, and healed when
# each executive has said what it lacks, the scout has done its command, and a console at world has then waited in vain for an executive that leads.
# The hosts are network namespaces of its own, on a bridge in a sixth; no packet leaves them. Needs root.
# Prints "step<TAB>exit code<TAB>output" for the steps flying, split (the event), lacks (what second says that it lacks), nobody (that console's exit code),
# untouched (what the world saw done until then), whole (the event), and, when all is over, goal (the event), world (exit code and summary of its launcher), effects (what the
# world saw done) and led (how often each began to lead).
set -uo pipefail
bin=$1 mission=$2 dds=$3 domain=$4 speed=$5
folder=$(mktemp -d)
declare -A address=([world]=10.82.0.1 [scout]=10.82.0.2 [primary]=10.82.0.3 [first]=10.82.0.4 [second]=10.82.0.5)
. "$(dirname "$0")/hosts.sh"
trap 'remove_hosts; rm -rf "$folder"' EXIT
make_hosts

launch() {  # host services options…; in a subshell, whose place it takes
  exec ip netns exec roci-$1-$$ timeout 250 "$bin/roci-launch" "$mission" --dds "$(vendor $1)" "${network[@]}" --address ${address[$1]} --services $2 --headless --json \
    --scenario nominal --clock live --speed $speed --run-folder "$folder/$1" "${@:3}" >"$folder/$1.summary" 2>"$folder/$1.log"
}
vendor() {  # host
  [[ $dds == mixed && ($1 == second || $1 == scout) ]] && echo cyclonedds || echo "${dds/mixed/fastdds}"
}
step() {  # name exit_code output
  printf '%s\t%s\t%s\n' "$1" "$2" "$3"
}
roci() {  # host arguments…
  ip netns exec roci-$1-$$ timeout 100 "$bin/roci" --dds "$(vendor $1)" "${network[@]}" --address ${address[$1]} "${@:2}" --json
}
effects() { echo "[$(paste -sd , "$folder/world/effects.jsonl")]"; }
flying() { kill -0 $world 2>/dev/null; }
until_line() {  # pattern file…: waits for it, or until the run is over
  while flying && ! grep -qs "$1" "${@:2}"; do sleep 0.1; done
  grep -hs "$1" "${@:2}" | tail -n 1
}
# A frame for a host that nobody has is lost without a word, one way and the other.
part() {  # on|off host host
  local from to
  for pair in "$2 $3" "$3 $2"; do
    read -r from to <<<"$pair"
    if [[ $1 == on ]]; then
      ip -n roci-$from-$$ neigh replace ${address[$to]} lladdr 02:00:00:00:00:01 dev eth nud permanent
    else
      ip -n roci-$from-$$ neigh del ${address[$to]} dev eth
    fi
  done
}
part_all() {  # on|off
  for other in world primary second; do part $1 first $other; done
  part $1 second scout
}

mkdir -m 700 "$folder/world" && touch "$folder/world/effects.jsonl"
launch world sim_svc,planner_svc &
world=$!
for host in scout primary; do launch $host $host.locomotion & done
launch first exec_svc --standby &
launch second exec_svc.standby --standby &
roci first events >"$folder/events" &
while flying && status=$(roci world status) && ! [[ $status =~ \"leader\":\"first\".*\"standby_ready\":true.*\"phase\":\"executing\" ]]; do :; done
step flying 0 "$status"
until_line '"object":"w1"' "$folder/world/effects.jsonl" >/dev/null
part_all on
step split 0 "$(until_line '"lead.split"' "$folder/events")"
step lacks 0 "\"$(until_line 'would lead, since' "$folder/second"/exec_svc*.log)\""
until_line '"kind":"press"' "$folder/world/effects.jsonl" >/dev/null
step nobody $(roci world status >"$folder/asked" 2>&1; echo $?) null
step untouched 0 "$(effects)"
part_all off
step whole 0 "$(until_line '"lead.whole"' "$folder/events")"
wait $world
step world $? "$(tail -n 1 "$folder/world.summary")"
step goal 0 "$(grep -h '"goal.achieved"' "$folder/events" | tail -n 1)"
step effects 0 "$(effects)"
for host in first second; do grep -c 'leads in epoch' "$folder/$host"/exec_svc*.log; done |
  paste -sd , | { read -r counts; step led 0 "[$counts]"; }
