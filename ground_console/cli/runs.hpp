// This is the verb `roci runs`: the history of this machine's runs, and its pruning.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

namespace roci::console::cli {

/// A run folder as roci-launch leaves it.
struct PastRun {
  std::filesystem::path folder;
  std::string mission;  ///< empty where the run left no summary; then it was cut short, or runs
  std::string scenario;
  std::string result;    ///< achieved, partial, failed; "running"; else "no summary" or "damaged summary"
  std::string goals;     ///< "3 achieved, 1 dropped"
  double mission_s = 0;  ///< mission time that it flew
  std::uintmax_t bytes = 0;
  bool running = false;
};

/// Where roci-launch puts run folders that it names itself: $XDG_STATE_HOME or ~/.local/state, rocinante/runs.
std::filesystem::path runs_folder();

/// The runs in a folder, newest first, as their names say. `running`: folders of runs that fly now.
std::vector<PastRun> past_runs(const std::filesystem::path& folder,
                               const std::set<std::filesystem::path>& running);

/// Removes all but the newest `keep`; one that runs stays, and counts as kept. Returns those that it removed.
std::vector<PastRun> prune(const std::vector<PastRun>& runs, std::size_t keep);

std::string runs_text(const std::vector<PastRun>& runs);
nlohmann::json runs_json(const std::vector<PastRun>& runs);

/// Lists the runs of this machine; with `prunes`, removes all but the newest `keep` of them. Returns an exit code.
int show_runs(bool prunes, std::size_t keep, bool json);

}  // namespace roci::console::cli
