#include "planner_svc/call_record.hpp"

#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace roci::planner {

void CallRecords::keep(const engine::Answer& answer, double wall_s) {
  if (folder_.empty()) return;
  std::error_code ignored;
  std::filesystem::create_directories(folder_, ignored);
  if (!std::exchange(looked_, true)) look_through_folder();
  const int number = calls_.empty() ? 1 : calls_.rbegin()->first + 1;
  const auto file = [&](const std::string& ending) {
    const auto path = folder_ / (std::to_string(number) + ending);
    calls_[number].push_back(path);
    return path;
  };
  const nlohmann::json outcome{{"verdict", to_string(answer.verdict)},
                               {"reason", answer.reason},
                               {"wall_s", wall_s},
                               {"evaluated", answer.statistics.evaluated},
                               {"expanded", answer.statistics.expanded},
                               {"function_requests", answer.statistics.function_requests},
                               {"function_tuples", answer.statistics.function_tuples},
                               {"exact_values", answer.statistics.exact_values},
                               {"from_remaining", answer.statistics.from_remaining},
                               {"actions", answer.plan ? answer.plan->activities.size() : 0}};
  for (const engine::RecordFile& part : answer.record) std::ofstream(file(part.ending)) << part.text;
  std::ofstream(file(".json")) << outcome.dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
                               << "\n";
  for (; calls_.size() > kKept; calls_.erase(calls_.begin()))
    for (const std::filesystem::path& old : calls_.begin()->second) std::filesystem::remove(old, ignored);
}

/// What an earlier process of the planner left there.
void CallRecords::look_through_folder() {
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator(folder_, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    take_in(entry->path());
}

void CallRecords::take_in(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  int number = 0;
  const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (fault == std::errc() && number > 0 && end != name.data() + name.size() && *end == '.')
    calls_[number].push_back(file);
}

}  // namespace roci::planner
