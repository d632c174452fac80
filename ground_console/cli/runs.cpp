#include "ground_console/cli/runs.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/cli/verbs.hpp"
#include "services/process/run_record.hpp"

namespace roci::console::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::uintmax_t size_of(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored)) bytes += entry.file_size(ignored);
  return bytes;
}

std::string goals_of(const json& summary) {
  std::string out;
  if (!summary.contains("goals") || !summary["goals"].is_object()) return out;
  for (const auto& [state, count] : summary["goals"].items())
    if (count.is_number_unsigned() && count != 0)
      out += (out.empty() ? "" : ", ") + count.dump() + " " + state;
  return out;
}

PastRun read_run(const fs::path& folder, bool running) {
  PastRun out;
  out.folder = folder;
  out.running = running;
  out.result = running ? "running" : "no summary";
  out.bytes = size_of(folder);
  std::ifstream in(folder / "summary.json");
  if (!in) return out;
  try {
    const json summary = json::parse(in);
    out.mission = fs::path(summary.at("mission").get<std::string>()).filename().string();
    out.scenario = summary.at("scenario").get<std::string>();
    out.goals = goals_of(summary);
    out.mission_s = summary.at("sim_s").get<double>();
    if (!running) out.result = summary.at("result").get<std::string>();
  } catch (const json::exception&) {
    if (!running) out.result = "damaged summary";
  }
  return out;
}

std::string megabytes(std::uintmax_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
  return text;
}

// Only what a launcher has made, whatever else stands in the folder of runs: "20261122T110459Z-…".
bool is_run_folder(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  return entry.is_directory() && !entry.is_symlink() && name.size() > 16 && name[8] == 'T' &&
         name[15] == 'Z' && name[16] == '-';
}

}  // namespace

fs::path runs_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0')
    return fs::path(state) / "rocinante" / "runs";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') return fs::path(home) / ".local/state" / "rocinante" / "runs";
  return services::process::runtime_folder() / "rocinante" / "runs";
}

std::vector<PastRun> past_runs(const fs::path& folder, const std::set<fs::path>& running) {
  std::vector<PastRun> out;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (is_run_folder(entry)) out.push_back(read_run(entry.path(), running.contains(entry.path())));
  std::ranges::sort(out, std::ranges::greater(), &PastRun::folder);
  return out;
}

std::vector<PastRun> prune(const std::vector<PastRun>& runs, std::size_t keep) {
  std::vector<PastRun> out;
  for (std::size_t i = keep; i < runs.size(); ++i) {
    if (runs[i].running) continue;
    fs::remove_all(runs[i].folder);
    out.push_back(runs[i]);
  }
  return out;
}

std::string runs_text(const std::vector<PastRun>& runs) {
  std::vector<std::vector<std::string>> rows{
      {"RUN", "MISSION", "SCENARIO", "RESULT", "GOALS", "FLOWN", "SIZE"}};
  std::uintmax_t bytes = 0;
  for (const PastRun& run : runs) {
    bytes += run.bytes;
    rows.push_back({run.folder.filename().string(), run.mission, run.scenario, run.result, run.goals,
                    run.mission_s > 0 ? lib::clock_text(static_cast<std::int64_t>(run.mission_s * 1e6)) : "",
                    megabytes(run.bytes)});
  }
  return table_text(rows) + std::to_string(runs.size()) + " runs, " + megabytes(bytes) + "\n";
}

json runs_json(const std::vector<PastRun>& runs) {
  json out = json::array();
  for (const PastRun& run : runs)
    out.push_back({{"folder", run.folder.string()},
                   {"mission", run.mission},
                   {"scenario", run.scenario},
                   {"result", run.result},
                   {"goals", run.goals},
                   {"sim_s", run.mission_s},
                   {"bytes", run.bytes}});
  return out;
}

int show_runs(bool prunes, std::size_t keep, bool as_json) {
  std::set<fs::path> running;
  for (const auto& record : services::process::find_runs(services::process::runtime_folder()))
    running.insert(record.run_folder);
  std::vector<PastRun> runs = past_runs(runs_folder(), running);
  if (prunes) runs = prune(runs, keep);
  if (as_json) {
    std::cout << json_text(runs_json(runs)) << "\n";
  } else if (runs.empty()) {
    std::cout << (prunes ? "nothing to remove in " : "no runs in ") << runs_folder().string() << "\n";
  } else {
    std::cout << (prunes ? "removed from " : "") << runs_folder().string() << "\n" << runs_text(runs);
  }
  return kDone;
}

}  // namespace roci::console::cli
