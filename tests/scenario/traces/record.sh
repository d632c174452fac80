#!/usr/bin/env bash
# Flies a mission's scenarios with a build and keeps the trace of each flight as text:
#   record.sh BIN_DIR OUT_DIR [SEEDS] [SCENARIO ...]
# BIN_DIR is the bin folder of a build (build/PRESET/bin of its own tree, whose mission is flown); SEEDS is a number
# or a range (1-20, the default); without names all scenarios are flown. Each flight is a process of its own, JOBS (2)
# at a time. OUT_DIR gets SCENARIO-SEED.trace and SCENARIO-SEED.summary.json. The environment may name MISSION
# (planetary) and ROCI_TRACE, the roci-trace of another build, for builds that have none.
# Exits 0 when each flight has left its trace, 1 when one has not, 2 for wrong use.
set -euo pipefail

usage() { sed -n '2,9s/^# //p' "$0" >&2; exit 2; }
(($# >= 2)) || usage
bin=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
seeds=${3:-1-20}
shift $(($# > 2 ? 3 : 2))
tree=$(cd "$bin/../../.." && pwd)
mission=$tree/missions/${MISSION:-planetary}
trace=${ROCI_TRACE:-$bin/roci-trace}
for program in "$bin/roci-rehearse" "$trace"; do
  [[ -x $program ]] || { echo "record.sh: there is no program $program; build it, or name another BIN_DIR or ROCI_TRACE" >&2; exit 2; }
done
[[ -f $mission/mission.yaml ]] || { echo "record.sh: there is no mission $mission; MISSION names one of $tree/missions" >&2; exit 2; }
[[ $seeds =~ ^[0-9]+(-[0-9]+)?$ ]] || usage
scenarios=("$@")
if ((${#scenarios[@]} == 0)); then
  for file in "$mission"/scenarios/*.yaml; do scenarios+=("$(basename "$file" .yaml)"); done
fi

# Codes 0 and 1 tell how a mission ended; here it counts that it ended.
fly() {
  local scenario=$1 seed=$2 run code=0
  run=$(mktemp -d)
  "$bin/roci-rehearse" "$mission" --scenario "$scenario" --seed "$seed" --speed max --run-folder "$run" >"$run/out" 2>&1 || code=$?
  if ((code <= 1)) && [[ -f $run/summary.json ]] && "$trace" print --decisions "$run" >"$out/$scenario-$seed.trace"; then
    cp "$run/summary.json" "$out/$scenario-$seed.summary.json"
    rm -rf "$run"
  else
    echo "record.sh: $scenario with seed $seed left no trace (code $code); see $run/out" >&2
    return 1
  fi
}
export -f fly
export bin out mission trace

for scenario in "${scenarios[@]}"; do
  for seed in $(seq "${seeds%-*}" "${seeds#*-}"); do printf '%s %s\n' "$scenario" "$seed"; done
done | xargs -P "${JOBS:-2}" -L 1 bash -c 'fly "$0" "$1"' || exit 1
