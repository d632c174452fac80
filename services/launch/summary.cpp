#include "services/launch/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "services/process/link_report.hpp"
#include "services/process/run_summary.hpp"
#include "services/service.hpp"

namespace roci::services::launch {
namespace {

using nlohmann::json;

constexpr char kServed[] = "served";

bool starts(const Options& options, const std::string& process) {
  return std::ranges::find(options.services, process) != options.services.end();
}

// Returns whether exec_svc runs here, with its standby if there is one; else another host may count the
// goals.
bool must_count_goals(const Options& options) {
  return std::ranges::any_of(options.list.services, [&](const mission::ServiceEntry& entry) {
    const bool here = entry.program == services::process::kExecutive && starts(options, entry.name);
    return here && (!options.standby || starts(options, standby_of(entry.name)));
  });
}

void complete(json& summary, const Options& options, const char* result) {
  const json fallback{{"format", services::kSummaryFormat},
                      {"mission", options.mission.filename().string()},
                      {"scenario", options.scenario},
                      {"seed", options.seed},
                      {"result", result},
                      {"goals", {{"achieved", 0}, {"dropped", 0}, {"failed", 0}}},
                      {"planner", {{"calls", 0}, {"max_s", 0.0}, {"max_rss_mb", 0.0}}},
                      {"replans", 0},
                      {"sim_s", 0.0},
                      {"trace_sha256", ""}};
  for (const auto& [key, value] : fallback.items()) {
    if (!summary.contains(key)) summary[key] = value;
  }
  std::ifstream expected(options.run_folder / services::kExpectedFile);
  if (expected) {
    const json report = json::parse(expected, nullptr, false);
    const bool whole = report.is_object() && (!report.contains("fault") || report["fault"].is_string());
    if (whole) summary["expected"] = report;
  }
  const auto links = process::read_link_reports(options.run_folder);
  if (!links.empty()) summary["links"] = process::as_json(links);
}

// Returns a line of its own, if the scenario says what is to happen.
std::string expected_text(const json& summary) {
  const auto expected = summary.find("expected");
  if (expected == summary.end() || !expected->is_object()) return "";
  const std::string fault = expected->value("fault", "");
  return "  events    " + (fault.empty() ? "as the scenario expects" : fault) + "\n";
}

// Returns what is told of goals where there are some: rejected ones, and those that the run has ended without.
std::string more_goals_text(const json& goals) {
  std::string out;
  for (const char* state : {"rejected", "open"})
    if (const int count = goals.value(state, 0); count > 0) out += fmt::format(", {} {}", count, state);
  return out;
}

// Returns a line for each of several executives.
std::string executives_text(const json& summary) {
  std::string out;
  const json executives = summary.value("executives", json::object());
  for (const auto& [name, own] : executives.items()) {
    const json goals = own.value("goals", json::object());
    out += fmt::format("  {:<9} {}: {} achieved, {} dropped, {} failed{}\n", name,
                       own.value("result", "failed"), goals.value("achieved", 0), goals.value("dropped", 0),
                       goals.value("failed", 0), more_goals_text(goals));
  }
  return out;
}

// Returns a line for each link that the scenario declares and that carried something.
std::string links_text(const json& summary) {
  std::string out;
  if (!summary.contains("links")) return out;
  for (const auto& [name, counts] : summary["links"].items()) {
    out += fmt::format("  link      {}: {} samples, {} lost, {} sent again, {} superseded\n", name,
                       counts.value("offered", 0), counts.value("lost", 0), counts.value("repeated", 0),
                       counts.value("superseded", 0));
  }
  return out;
}

std::string text_without_goals(const json& summary, const Options& options) {
  return fmt::format(
      "{} {}: {} here for {:.1f} s; the goals are counted where exec_svc leads\n  run       {}\n",
      summary.value("mission", ""), summary.value("scenario", ""), summary.value("result", ""),
      summary.value("wall_s", 0.0), options.run_folder.string());
}

std::string text_with_goals(const json& summary, const Options& options) {
  const json& goals = summary["goals"];
  const json& planner = summary["planner"];
  return fmt::format(
      "{} {} (seed {}, {}): {}\n"
      "  goals     {} achieved, {} dropped, {} failed{}\n"
      "{}"
      "  planner   {} calls, slowest {:.2f} s, {:.0f} MB; {} replans\n"
      "  time      {:.0f} s of mission in {:.1f} s\n"
      "{}{}"
      "  run       {}\n",
      summary.value("mission", ""), summary.value("scenario", ""), summary.value("seed", std::uint64_t{0}),
      summary.value("dds", ""), summary.value("result", ""), goals.value("achieved", 0),
      goals.value("dropped", 0), goals.value("failed", 0), more_goals_text(goals), executives_text(summary),
      planner.value("calls", 0), planner.value("max_s", 0.0), planner.value("max_rss_mb", 0.0),
      summary.value("replans", 0), summary.value("sim_s", 0.0), summary.value("wall_s", 0.0),
      expected_text(summary), links_text(summary), options.run_folder.string());
}

}  // namespace

Summary complete_summary(const Options& options, double wall_s, bool ended_well) {
  json summary = services::process::read_summary(options.run_folder, options.list);
  const bool counts_goals = !summary.empty() || must_count_goals(options);
  complete(summary, options, ended_well && !counts_goals ? kServed : "failed");
  summary["dds"] = options.connection.dds;
  summary["wall_s"] = wall_s;
  std::ofstream(options.run_folder / services::kSummaryFile)
      << summary.dump(2, ' ', false, json::error_handler_t::replace) << '\n';
  const std::string result = summary.value("result", "");
  return {result == "achieved" || result == kServed,
          summary.dump(-1, ' ', false, json::error_handler_t::replace),
          counts_goals ? text_with_goals(summary, options) : text_without_goals(summary, options)};
}

}  // namespace roci::services::launch
