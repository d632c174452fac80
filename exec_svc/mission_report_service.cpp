#include "exec_svc/mission_report_service.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace roci::exec {

using mission::MissionModel;
using mission::WindowModel;
using reactor::Reactor;
using reactor::ReactorCounts;

v1::MissionStatus mission_status(const Reactor& reactor, const MissionModel& mission) {
  v1::MissionStatus status;
  const ReactorCounts counts = reactor.counts();
  status.mission(mission.name);
  status.held(reactor.held());
  status.phase(static_cast<v1::MissionPhase>(reactor.phase()));
  status.plan_version(reactor.plan_version());
  status.replans(counts.replans);
  status.goals_achieved(counts.achieved);
  status.goals_dropped(counts.dropped);
  status.goals_failed(counts.failed);
  status.goals_open(counts.open);
  status.outcome(reactor.outcome());
  for (const WindowModel& window : mission.windows) {
    for (const auto& [opens, closes] : window.open) {
      v1::PredictedWindow predicted;
      predicted.timeline(window.timeline);
      predicted.opens_us(opens.count());
      predicted.closes_us(closes.count());
      status.windows().push_back(predicted);
    }
  }
  return status;
}

void write_summary(const std::filesystem::path& file, const services::RunSettings& settings,
                   const MissionModel& mission, const Reactor& reactor, const RunFigures& figures) {
  const ReactorCounts counts = reactor.counts();
  const std::string outcome = reactor.outcome();
  const nlohmann::json summary{{"format", services::kSummaryFormat},
                               {"mission", mission.name},
                               {"scenario", settings.scenario},
                               {"seed", settings.seed},
                               {"result", outcome.empty() ? "failed" : outcome},
                               {"goals",
                                {{"achieved", counts.achieved},
                                 {"dropped", counts.dropped},
                                 {"failed", counts.failed},
                                 {"rejected", counts.rejected},
                                 {"open", counts.open}}},
                               {"planner",
                                {{"calls", counts.planner_calls},
                                 {"max_s", figures.slowest_call_s},
                                 {"max_rss_mb", figures.planner_peak_mb}}},
                               {"replans", counts.replans},
                               {"sim_s", figures.sim_s},
                               {"trace_sha256", figures.trace_sha256},
                               {"journal", figures.journal.lexically_relative(settings.run_folder).string()},
                               {"epoch", figures.epoch}};
  std::ofstream(file) << summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

}  // namespace roci::exec
