#include "planner_svc/call_record.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace roci::planner {

void CallRecords::keep(const engine::Answer& answer, double wall_s) {
  if (folder_.empty()) return;
  std::error_code ignored;
  std::filesystem::create_directories(folder_, ignored);
  const auto file = [this](const std::string& ending) { return folder_ / (std::to_string(last_) + ending); };
  do {
    ++last_;
  } while (std::filesystem::exists(file(".json"), ignored));
  const nlohmann::json outcome{{"verdict", to_string(answer.verdict)},
                               {"reason", answer.reason},
                               {"wall_s", wall_s},
                               {"evaluated", answer.statistics.evaluated},
                               {"expanded", answer.statistics.expanded},
                               {"from_remaining", answer.statistics.from_remaining},
                               {"actions", answer.plan ? answer.plan->activities.size() : 0}};
  for (const engine::RecordFile& part : answer.record) std::ofstream(file(part.ending)) << part.text;
  std::ofstream(file(".json")) << outcome.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

}  // namespace roci::planner
