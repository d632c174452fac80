#!/usr/bin/env bash
# What an operator types while a mission flies: each answer is a file of OUT, its exit code stands in FILE.code.
# operator.sh BIN MISSION SCENARIO DDS DOMAIN OUT SPEED asked|obstacle|ended
set -u
mission=$2 scenario=$3 dds=$4 domain=$5 out=$6 speed=$7
export PATH=$1:$PATH
joins=(--domain "$domain" --dds "$dds")
export XDG_STATE_HOME=$out/state
runs=$out/state/rocinante/runs  # where `roci runs` looks
mkdir -p "$runs"
roci-launch "$mission" --scenario "$scenario" --dds "$dds" --domain "$domain" --speed "$speed" --headless --json \
  --run-folder "$runs/20990101T000000Z-flight" >"$out/summary" 2>&1 &
launcher=$!
ln -s "$runs/20990101T000000Z-flight" "$out/run"
listener=
trap 'kill $listener 2>/dev/null; kill -INT $launcher 2>/dev/null; wait' EXIT
ask() {
  local file=$out/$1
  shift
  timeout 60 roci "$@" "${joins[@]}" >"$file" 2>"$file.err"
  echo $? >"$file.code"
}
# Asks until the answer holds a text, for half a minute at most.
ask_until() {
  local text=$1
  shift
  for _ in $(seq 60); do
    kill -0 $launcher 2>/dev/null || break
    ask "$@"
    grep -q -- "$text" "$out/$1" && return 0
  done
  return 1
}
case $8 in
  asked)
    ask_until planetary status status
    roci events --json "${joins[@]}" >"$out/events" 2>/dev/null &
    listener=$!
    for _ in $(seq 60); do  # until it hears something
      [[ -s $out/events ]] && break
      ask order order release
    done
    ask first goal add ridge photo x=110 y=60 --class hard
    ask_until running plan plan
    asking=()
    in_parallel() { ask "$@" & asking+=($!); }
    in_parallel plan.json plan --json
    in_parallel timelines timelines
    in_parallel there reach 110 60 --json
    in_parallel steep reach 190 60
    in_parallel outside reach 1000 60
    in_parallel why plan --why drive
    in_parallel why.json plan --why p1.1-drive --json
    in_parallel nothing plan --why dance
    wait "${asking[@]}"
    ask second goal add second photo x=60 y=45   # one more planner call
    ask_until 'plan 2,' after plan
    ask steep-goal goal add steep photo x=190 y=60 --wait
    mkdir "$runs/20260101T000000Z-old" "$runs/20260102T000000Z-older" "$runs/no-run-of-a-launcher"
    roci runs --json >"$out/runs"
    roci runs --prune --keep 1 --json >"$out/pruned"
    roci runs --prune --keep 0 >"$out/pruned-again"
    ls "$runs" >"$out/kept"
    ;;
  ended)
    ask_until planetary status status
    ask open-goal goal add open photo x=60 y=60 --wait
    ;;
  obstacle)
    ask_until ' \* ' older plan
    ask older.json plan --why drive --json
    ;;
esac
