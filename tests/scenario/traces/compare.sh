#!/usr/bin/env bash
# Compares what two builds do in a mission's scenarios, line by line, under one committed renaming:
#   compare.sh OLD NEW [SEEDS] [SCENARIO ...]
# OLD and NEW are bin folders of builds, or folders that record.sh filled (their traces may be packed: *.trace.xz).
# SEEDS is a number or a range (1-20, the default). The environment may name MAP (baseline-05.map.yaml beside this
# script), ROCI_TRACE (the roci-trace of NEW), JOBS (2), MISSION (planetary), and DECISIONS=1 to compare the goals,
# events, steps and planner calls, too. Exit codes are those of roci-trace compare: 0 equal, 1 different, 2 unreadable.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

usage() { sed -n '2,7s/^# //p' "$0" >&2; exit 2; }
(($# >= 2)) || usage
old=$1
new=$2
seeds=${3:-1-20}
shift $(($# > 2 ? 3 : 2))
[[ $seeds =~ ^[0-9]+(-[0-9]+)?$ ]] || usage
if [[ -z ${ROCI_TRACE:-} ]]; then
  for folder in "$new" "$old"; do
    [[ -x $folder/roci-trace ]] && ROCI_TRACE=$(cd "$folder" && pwd)/roci-trace && break
  done
fi
[[ -x ${ROCI_TRACE:-} ]] || { echo "compare.sh: there is no roci-trace in $new; build it, or name it in ROCI_TRACE" >&2; exit 2; }
export ROCI_TRACE

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Puts the wanted traces of a build or of a record into a folder.
gather() {
  local from=$1 to=$2 file name
  shift 2
  mkdir -p "$to"
  if [[ -x $from/roci-rehearse ]]; then
    "$here/record.sh" "$from" "$to" "$seeds" "$@" || exit 2
    return
  fi
  for file in "$from"/*.trace "$from"/*.trace.xz; do
    [[ -f $file ]] || continue
    name=$(basename "${file%.xz}")
    wanted "${name%.trace}" "$@" || continue
    if [[ $file == *.xz ]]; then xz -dc "$file" >"$to/$name"; else cp "$file" "$to/$name"; fi
  done
  compgen -G "$to/*.trace" >/dev/null || { echo "compare.sh: $from is neither a bin folder nor a record with these runs" >&2; exit 2; }
}

# Whether a run SCENARIO-SEED is among the seeds and the scenarios.
wanted() {
  local run=$1 scenario
  shift
  local seed=${run##*-}
  ((seed >= ${seeds%-*} && seed <= ${seeds#*-})) || return 1
  (($# == 0)) && return 0
  for scenario in "$@"; do [[ ${run%-*} == "$scenario" ]] && return 0; done
  return 1
}

gather "$old" "$work/old" "$@"
gather "$new" "$work/new" "$@"
"$ROCI_TRACE" compare "$work/old" "$work/new" --map "${MAP:-$here/baseline-05.map.yaml}" ${DECISIONS:+--decisions}
