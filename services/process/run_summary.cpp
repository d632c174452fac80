#include "services/process/run_summary.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "services/service.hpp"

namespace roci::services::process {
namespace {

using nlohmann::json;

// Whether what is read by name below is of the kind that it is read as.
bool fits(const json& value, const json& pattern) {
  if (pattern.is_string()) return value.is_string();
  if (pattern.is_number()) return value.is_number();
  if (!value.is_object()) return false;
  return std::ranges::all_of(value.items(), [&](const auto& member) {
    return !pattern.contains(member.key()) || fits(member.value(), pattern.at(member.key()));
  });
}

bool is_summary(const json& value) {
  static const json kPattern{{"format", 1},
                             {"mission", ""},
                             {"scenario", ""},
                             {"seed", 1},
                             {"dds", ""},
                             {"result", ""},
                             {"goals", json::object()},
                             {"planner", {{"calls", 1}, {"max_s", 1}, {"max_rss_mb", 1}}},
                             {"replans", 1},
                             {"sim_s", 1},
                             {"wall_s", 1},
                             {"trace_sha256", ""}};
  if (!value.is_object() || !fits(value, kPattern)) return false;
  const json goals = value.value("goals", json::object());
  return std::ranges::all_of(goals, [](const json& count) { return count.is_number(); });
}

// A damaged file is none.
json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  json summary = json::parse(in, nullptr, false);
  if (!is_summary(summary)) return json::object();
  const int format = summary.value("format", 1);
  if (format > kSummaryFormat)
    throw std::runtime_error(file.string() + " is of format " + std::to_string(format) +
                             ", this program reads up to " + std::to_string(kSummaryFormat) +
                             "; fly with programs of one version");
  return summary;
}

bool had_goals(const json& summary) {
  const json goals = summary.value("goals", json::object());
  return std::ranges::any_of(goals, [](const json& count) { return count != 0; });
}

// What all of them did, counted up as their summaries are read.
struct Totals {
  std::map<std::string, int> goals;
  int calls = 0, replans = 0;
  double max_s = 0, max_rss_mb = 0, sim_s = 0;

  void add(const json& summary) {
    const json of_one = summary.value("goals", json::object());
    for (const auto& [state, count] : of_one.items()) goals[state] += count.get<int>();
    const json planner = summary.value("planner", json::object());
    calls += planner.value("calls", 0);
    max_s = std::max(max_s, planner.value("max_s", 0.0));
    max_rss_mb = std::max(max_rss_mb, planner.value("max_rss_mb", 0.0));
    replans += summary.value("replans", 0);
    sim_s = std::max(sim_s, summary.value("sim_s", 0.0));
  }
  void put(json& summary) const {
    summary["goals"] = goals;
    summary["planner"] = {{"calls", calls}, {"max_s", max_s}, {"max_rss_mb", max_rss_mb}};
    summary["replans"] = replans;
    summary["sim_s"] = sim_s;
  }
};

std::string result_of(const json& executives) {
  std::string result;
  for (const auto& [name, summary] : executives.items()) {
    if (!summary.empty() && !had_goals(summary)) continue;
    const std::string own = summary.value("result", "failed");
    if (own == "failed" || result == "failed") {
      result = "failed";
    } else if (result.empty() || own != "achieved") {
      result = own;
    }
  }
  return result.empty() ? "failed" : result;
}

}  // namespace

json read_summary(const std::filesystem::path& run_folder, const mission::ServiceList& list) {
  const auto executives = list.of_program(kExecutive);
  if (executives.size() <= 1) return read_json(run_folder / kSummaryFile);
  json total = json::object();
  json each = json::object();
  Totals totals;
  bool found = false;
  for (const mission::ServiceEntry* executive : executives) {
    const json own = read_json(run_folder / list.file_name(executive->name, kSummaryFile));
    each[executive->name] = own;
    if (own.empty()) continue;
    found = true;
    for (const char* key : {"format", "mission", "scenario", "seed"})
      if (own.contains(key)) total[key] = own.at(key);
    totals.add(own);
  }
  if (!found) return json::object();
  totals.put(total);
  total["result"] = result_of(each);
  total["executives"] = std::move(each);
  return total;
}

}  // namespace roci::services::process
