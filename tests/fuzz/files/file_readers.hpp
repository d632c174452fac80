// Every source file that opens a file which somebody else may have written, and the test that damages what it reads.
#pragma once

#include <map>
#include <string>

namespace roci::fuzz {

/// By the path of the source: "TestSuite.Test" of tests/fuzz, or why there is none ("- reason"). A test fails when a
/// source that opens a file is missing here.
inline const std::map<std::string, std::string> kFileReaders{
    {"arm_svc/setup_file.cpp", "FuzzMissions.IsTakenOrRefusedWithItsPlace"},
    {"core/mission/entry.cpp", "FuzzMissions.IsTakenOrRefusedWithItsPlace"},
    {"core/mission/model_text.cpp", "FuzzTimelineModels.ADamagedFileIsTakenOrRefusedWithItsPlace"},
    {"core/terrain/pgm.cpp", "FuzzMissions.IsTakenOrRefusedWithItsPlace"},
    {"dedicated_svc/call_record_service.cpp", "FuzzRunFiles.AreReadOrRefused"},
    {"exec_svc/journal/database.cpp", "FuzzJournal.ADamagedFileIsReadOrRefused"},
    {"exec_svc/journal/journal_batches.cpp", "FuzzStandby.ADamagedJournalIsCopiedOrRefused"},
    {"exec_svc/journal/high_water_mark.cpp", "FuzzRunFiles.AreReadOrRefused"},
    {"exec_svc/journal/first_page.cpp", "FuzzJournal.ADamagedFileIsReadOrRefused"},
    {"exec_svc/journal/salvage.cpp", "FuzzJournal.ADamagedFileIsReadOrRefused"},
    {"exec_svc/standby/persisted_term_file.cpp", "FuzzRunFiles.AreReadOrRefused"},
    {"exec_svc/trace/journal_reader.cpp", "FuzzRunFiles.ARecordedRunIsReadOrRefused"},
    {"exec_svc/trace/run_reader.cpp", "FuzzRunFiles.ARecordedRunIsReadOrRefused"},
    {"ground_console/cli/map/run_folder.cpp", "- JSON of a run of one's own; what is none counts as absent"},
    {"ground_console/cli/map/map.cpp",
     "- files of a run that ended, shown as a picture; what is no JSON counts as absent"},
    {"ground_console/cli/network.cpp", "- what roci-network has just packed, in a folder of its own"},
    {"ground_console/cli/orders.cpp", "- bytes that the user uploads, sent as they are"},
    {"ground_console/cli/runs.cpp", "FuzzRunFiles.AreReadOrRefused"},
    {"ground_console/lib/client.cpp", "- /proc, which the kernel writes"},
    {"planner_svc/network_store_service.cpp", "FuzzNetworkStore.ADamagedListIsTakenOrNamed"},
    {"planner_svc/temporal_pddl/cli/main.cpp", "FuzzPddl.MutatedCorpusNeverCrashes"},
    {"planner_svc/temporal_pddl/cli/progress_line.cpp", "- /proc/self, which the kernel writes"},
    {"planner_svc/temporal_pddl/cli/read_model.cpp", "FuzzPddl.MutatedCorpusNeverCrashes"},
    {"planner_svc/temporal_pddl/validate/main.cpp", "FuzzPddl.MutatedCorpusNeverCrashes"},
    {"planner_svc/timeline_htn/cli/commands.cpp", "FuzzPddl.MutatedCorpusNeverCrashes"},
    {"planner_svc/timeline_htn/reading/load.cpp",
     "FuzzTimelineModels.ADamagedFileIsTakenOrRefusedWithItsPlace"},
    {"planner_svc/utility_htn/cli/commands.cpp",
     "- opens a file to see whether it can be read; what reads it is load.cpp"},
    {"planner_svc/utility_htn/cli/cycle.cpp",
     "FuzzStepRecords.ADamagedRecordIsPlannedAgainOrRefusedWithItsPlace"},
    {"planner_svc/utility_htn/reading/load.cpp", "FuzzNetworks.ADamagedFileIsTakenOrRefusedWithItsPlace"},
    {"rehearsal/main.cpp", "- a file that this very process wrote"},
    {"rehearsal/statistics.cpp", "- files that this very process wrote"},
    {"services/clock/host_anchor.cpp", "- /proc, which the kernel writes"},
    {"services/health/heartbeat_sender.cpp", "- /proc/self, which the kernel writes"},
    {"services/launch/continuation.cpp", "- the launcher's own file; only unit tests read bad ones so far"},
    {"services/launch/run.cpp", "- the end of a log, shown as text"},
    {"services/launch/summary.cpp", "FuzzRunFiles.AreReadOrRefused"},
    {"services/owner/ledger_file.cpp", "- the owner's own file; only unit tests read bad ones so far"},
    {"services/process/incarnation.cpp", "FuzzRunFiles.AreReadOrRefused"},
    {"services/process/link_report.cpp", "FuzzRunFiles.AreReadOrRefused"},
    {"services/process/run_record.cpp", "FuzzRunFiles.AreReadOrRefused"},
    {"services/process/run_summary.cpp", "FuzzRunFiles.AreReadOrRefused"},
    {"services/security/issued.cpp", "FuzzKeys.ADamagedFileIsReadOrRefused"},
    {"services/security/key_folder.cpp", "FuzzKeys.ADamagedFileIsReadOrRefused"},
    {"sim_svc/components/dynamic_arm_settings.cpp",
     "- the URDF, read by core/kinematics as in arm_svc: FuzzMissions"},
    {"sim_svc/scenario/stimuli_file.cpp", "- bytes that a scenario sends as they are, 15 MiB at most"},
    {"sim_svc/world_file_service.cpp", "FuzzRunFiles.AreReadOrRefused"},
};

}  // namespace roci::fuzz
