// What an engine tells of data and downlinks is no part of a FlexiblePlan. It is checked from the record of a flight
// (R126, R127), where everything is at hand that the engine had heard.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/projection.hpp"
#include "planner_svc/engine/plan_history.hpp"
#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/checking/question.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::checking {

/// Follows an engine step by step, and has check_downlinks() compute anew what the schedules say: each product of the
/// plan and each that waits on board stands in them once, as the network or its owner says; each downlink is one of
/// the plan and carries no more than its time, its energy and that of its sol allow; tiers go in their order and with
/// the windows that appendix A asks for, or a reason is given.
///
/// Of a downlink that runs only its whole capacity is known here, not what is left of it. What an activity that is
/// late will generate may be told or not, and when is the engine's to say. Data of an activity that stood in the plan
/// before may have lost their downlink, with the reason told.
class ScheduleChecker {
 public:
  /// Takes in what a step hears and what comes of it, with the network then in force. Returns what is wrong with the
  /// newest schedule as one sentence each, where the step told one or changed the plan.
  std::vector<std::string> faults(const model::Network& network, const engine::StepInputs& inputs,
                                  const engine::StepOutput& output);
  /// Counts the schedules that were checked.
  std::uint64_t checked() const { return checked_; }

 private:
  void hear(const engine::StepInputs& inputs);

  temporal::FlexiblePlan plan_;  // the newest one
  engine::PlanHistory history_;  // what an executive that was started again knows may be an older one
  temporal::Progress progress_;
  std::map<std::string, engine::DataProduct> on_board_;  // by id; those that wait for a downlink
  std::set<std::pair<std::uint64_t, std::string>> generated_;  // by step, with the product's name
  std::optional<engine::DownlinkSchedule> schedule_;
  std::uint64_t checked_ = 0;
};

}  // namespace roci::planner::utility_htn::checking
