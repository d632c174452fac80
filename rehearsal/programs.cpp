#include "arm_svc/arm_service.hpp"
#include "dedicated_svc/dedicated_service.hpp"
#include "exec_svc/exec_service.hpp"
#include "pathplan_svc/pathplan_service.hpp"
#include "planner_svc/planner_service.hpp"
#include "rehearsal/flight.hpp"
#include "science_svc/science_service.hpp"
#include "sim_svc/sim_service.hpp"

namespace roci::rehearsal {

const std::vector<Program>& programs() {
  static const std::vector<Program> all = {
      {"arm_svc", arm::make_service},         {"dedicated_svc", dedicated::make_service},
      {"exec_svc", exec::make_service},       {"pathplan_svc", pathplan::make_service},
      {"planner_svc", planner::make_service}, {"science_svc", science::make_service},
      {"sim_svc", sim::make_service}};
  return all;
}

}  // namespace roci::rehearsal
