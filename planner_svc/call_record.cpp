#include "planner_svc/call_record.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace roci::planner {

using temporal_pddl::adapter::PlanningAnswer;
using temporal_pddl::adapter::PlanningCall;

void CallRecords::keep(const PlanningCall& call, const PlanningAnswer& answer, double wall_s) {
  if (folder_.empty()) return;
  std::error_code ignored;
  std::filesystem::create_directories(folder_, ignored);
  const auto file = [this](const char* ending) { return folder_ / (std::to_string(last_) + ending); };
  do {
    ++last_;
  } while (std::filesystem::exists(file(".pddl"), ignored));
  const nlohmann::json outcome{{"verdict", to_string(answer.verdict)},
                               {"reason", answer.reason},
                               {"wall_s", wall_s},
                               {"evaluated", answer.statistics.evaluated},
                               {"expanded", answer.statistics.expanded},
                               {"from_remaining", answer.statistics.from_remaining},
                               {"actions", answer.plan ? answer.plan->activities.size() : 0}};
  std::ofstream(file(".pddl")) << call.problem_text;
  std::ofstream(file(".values")) << pddl::print(answer.function_values);
  if (!call.remaining.empty()) std::ofstream(file(".remaining")) << pddl::print_plan(call.remaining);
  std::ofstream(file(".json")) << outcome.dump(2) << "\n";
}

}  // namespace roci::planner
