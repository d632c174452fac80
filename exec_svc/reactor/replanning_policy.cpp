#include "exec_svc/reactor/replanning_policy.hpp"

#include "exec_svc/reactor/background_replan.hpp"
#include "exec_svc/reactor/continuous_planning.hpp"
#include "exec_svc/reactor/stop_and_replan.hpp"

namespace roci::exec::reactor {

using mission::Replanning;

std::unique_ptr<ReplanningPolicy> make_replanning_policy(Replanning kind, const PolicyParts& parts) {
  switch (kind) {
    case Replanning::stop_and_replan:
      return std::make_unique<StopAndReplan>(parts);
    case Replanning::background:
      return std::make_unique<BackgroundReplan>(parts);
    case Replanning::continuous:
      return std::make_unique<ContinuousPlanning>(parts);
  }
  return std::make_unique<StopAndReplan>(parts);
}

}  // namespace roci::exec::reactor
