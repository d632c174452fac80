#!/usr/bin/env bash
# Looks for data races with the thread sanitizer (preset tsan); ./check --full calls it.
#   run.sh targets             prints what is to be built
#   run.sh inproc [PROGRAM]    runs what has threads of ours, over inproc, without any suppression
#   run.sh vendors [PROGRAM]   runs the transport's contract over both vendors, with vendors.txt: a reason for each line
# Prints the programs that it runs; the first race that is found ends it with code 66.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../../build/tsan

over_inproc=(
  unit_services unit_services_owner unit_sim_service unit_exec_service
  unit_timeline_htn_search unit_planner_service unit_rehearsal_check
  contract_transport contract_robots contract_check contract_functions contract_cancel contract_console
  contract_continuous_planning contract_standby
  scenario_goals scenario_reality scenario_topic_rights
)
over_vendors=(unit_services_vendors contract_transport contract_check contract_cancel)
# Of some programs other cases than those that their transport's name tells.
declare -A cases=([unit_timeline_htn_search]='Resolvers.*' [unit_services_vendors]='*')

# Over the vendors two cases are left out: one measures the process's memory, most of which is the sanitizer's here, and
# one sends two megabytes, for which the sanitizer, busy with reports that it suppresses, takes longer than the case waits.
not_over_vendors='Transports/Instances.WhatIsForgottenTakesNoMemory/*:Transports/Isolation.ATwoMegabyteSampleArrivesWhole/cyclonedds_to_fastdds'

race_free() {  # OPTIONS FILTER PROGRAM: without address randomization, which this sanitizer of GCC 12 cannot always take
  echo "tsan: $3 $2" >&2
  TSAN_OPTIONS="halt_on_error=1 exitcode=66 second_deadlock_stack=1 history_size=4 $1" \
    setarch "$(uname -m)" -R "$build/tests/$3" --gtest_brief=1 --gtest_filter="$2"
}

only=${2:-}
case ${1:-} in
  targets) printf '%s\n' "${over_inproc[@]}" "${over_vendors[@]}" | sort -u ;;
  inproc)
    for program in ${only:-"${over_inproc[@]}"}; do
      race_free "" "${cases[$program]:--*fastdds*:*cyclonedds*:*mixed*}" "$program"
    done
    ;;
  vendors)
    for program in ${only:-"${over_vendors[@]}"}; do
      race_free "suppressions=$here/vendors.txt" "${cases[$program]:-*fastdds*:*cyclonedds*}-$not_over_vendors" "$program"
    done
    ;;
  *) sed -n '2,6s/^# //p' "$0" >&2; exit 2 ;;
esac
