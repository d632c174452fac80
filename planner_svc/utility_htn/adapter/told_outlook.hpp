// The told outlook is what planner_svc has been given of schedule and outlook, each once.
#pragma once

#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/adapter/outlook.hpp"
#include "planner_svc/utility_htn/adapter/planned_network.hpp"

namespace roci::planner::utility_htn::adapter {

/// Tells schedule and outlook where they have changed. While all goes as foreseen, nothing is computed.
class ToldOutlook {
 public:
  /// Takes in that something was heard that an outlook tells.
  void look_again() { to_look_ = true; }
  /// Puts into `out` what is new after a cycle, before which these blocks had begun. The delivery learns what its
  /// downlinks are told to send.
  void tell(PlannedNetwork& planned, const cycle::Report& report,
            const std::vector<cycle::Block>& begun_before, temporal::Time now, engine::StepOutput& out);

 private:
  Outlooks outlooks_;
  engine::DownlinkSchedule schedule_;
  engine::MissionOutlook outlook_;
  bool to_look_ = true;
};

}  // namespace roci::planner::utility_htn::adapter
