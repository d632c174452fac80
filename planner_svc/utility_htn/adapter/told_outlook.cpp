#include "planner_svc/utility_htn/adapter/told_outlook.hpp"

#include <utility>

namespace roci::planner::utility_htn::adapter {

void ToldOutlook::tell(PlannedNetwork& planned, const cycle::Report& report,
                       const std::vector<cycle::Block>& begun_before, temporal::Time now,
                       engine::StepOutput& out) {
  const Situation situation = planned.situation(now);
  outlooks_.forgotten(situation, begun_before);
  if (!report.changed && report.explored == 0 && !to_look_) return;
  to_look_ = false;
  if (planned.plans_downlinks())  // without the Downlink Manager there is no schedule to tell
    if (engine::DownlinkSchedule schedule = schedule_of(situation); schedule != schedule_) {
      out.schedule = schedule_ = std::move(schedule);
      planned.delivery().told(products_by_task(schedule_));
    }
  if (engine::MissionOutlook outlook = outlooks_.make(situation); outlook != outlook_)
    out.outlook = outlook_ = std::move(outlook);
}

}  // namespace roci::planner::utility_htn::adapter
