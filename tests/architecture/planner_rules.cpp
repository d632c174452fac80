#include "tests/architecture/planner_rules.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace roci::architecture {
namespace {

const std::string kEngine = "planner_svc/temporal_pddl";
const std::string kTable = "planner_svc/engines.cpp";

// From the bottom to the top; "" is the engine's own folder. planner_svc/temporal_pddl/README.md tells them
// in the same order.
const std::vector<std::string> kFloors = {"call",
                                          "task",
                                          "constraints",
                                          "grounding/lifted",
                                          "grounding/reachability",
                                          "grounding/instantiation",
                                          "grounding/simplification",
                                          "grounding/invariants",
                                          "grounding/encoding",
                                          "grounding",
                                          "heuristics",
                                          "dead_ends",
                                          "search",
                                          "improvement",
                                          "extraction",
                                          "values",
                                          "",
                                          "adapter",
                                          "cli"};

// Folders that work on the ground task alone.
const std::set<std::string> kWithoutModel = {"call",      "task",   "constraints", "heuristics",
                                             "dead_ends", "search", "improvement"};

std::string directory_of(const std::string& path) { return path.substr(0, path.find_last_of('/')); }

// The folder below the engine's, "" for the engine's own; nothing for files elsewhere.
std::optional<std::string> folder_in_engine(const std::string& path) {
  const std::string directory = directory_of(path);
  if (directory == kEngine) return "";
  if (!directory.starts_with(kEngine + "/")) return std::nullopt;
  return directory.substr(kEngine.size() + 1);
}

bool is_validator(const std::string& folder) { return folder == "validate"; }
bool is_checker(const std::string& folder) { return folder == "checker"; }

std::optional<std::size_t> floor_of(const std::string& folder) {
  const auto found = std::find(kFloors.begin(), kFloors.end(), folder);
  if (found == kFloors.end()) return std::nullopt;
  return static_cast<std::size_t>(found - kFloors.begin());
}

// Why a file of the engine's folder `from` must not reach the file `to`; empty if it may.
std::string forbids(const std::string& from, const std::string& to) {
  const std::optional<std::string> target = folder_in_engine(to);
  if (is_validator(from)) {
    const bool engine = to.starts_with("planner_svc/") && !(target && is_validator(*target));
    return engine ? "the validator shares only core/pddl" : "";
  }
  if (is_checker(from)) {
    const bool engine = target && !is_validator(*target) && !is_checker(*target);
    return engine ? "the checker sees the validator and nothing of the engine" : "";
  }
  if (from == "cli" && target && is_checker(*target))
    return "";  // it checks what it prints, as the host does
  if (target && (is_validator(*target) || is_checker(*target))) return "engines never see the validator";
  if (kWithoutModel.contains(from) && to.starts_with("core/pddl/")) return "the search never sees PDDL text";
  if (!target) return "";
  if (kWithoutModel.contains(from) && target->starts_with("grounding"))
    return "the search never sees the grounder";
  if (from == "dead_ends" && *target == "heuristics") return "detectors stand beside the heuristics";
  const auto own = floor_of(from);
  const auto other = floor_of(*target);
  if (!own || !other) return "";  // told by itself
  return *other > *own ? "a floor sees only those below it" : "";
}

class Reach {
 public:
  explicit Reach(const std::vector<SourceFile>& files) {
    for (const SourceFile& file : files) files_.emplace(file.path, &file);
  }

  // For each reason the first forbidden file that is met, breadth first, with the chain to it.
  void check(const SourceFile& file, const std::string& folder, std::vector<std::string>& out) const {
    std::map<std::string, std::string> reached_by{{file.path, ""}};
    std::vector<std::string> queue{file.path};
    std::set<std::string> told;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::string path = queue[i];
      const std::string reason = i == 0 ? "" : forbids(folder, path);
      if (!reason.empty()) {
        if (told.insert(reason).second)
          out.push_back(file.path + ": includes " + chain(path, reached_by) + "; " + reason);
        continue;
      }
      const auto found = files_.find(path);
      if (found == files_.end()) continue;
      for (const std::string& include : found->second->includes) {
        if (reached_by.emplace(include, path).second) queue.push_back(include);
      }
    }
  }

 private:
  static std::string chain(const std::string& last, const std::map<std::string, std::string>& reached_by) {
    std::string text = last;
    for (std::string by = reached_by.at(last); !reached_by.at(by).empty(); by = reached_by.at(by))
      text = by + " -> " + text;
    return text;
  }

  std::map<std::string, const SourceFile*> files_;
};

// "temporal_pddl" of planner_svc/temporal_pddl/…; empty for the seam itself and what hosts engines.
std::string engine_of(const std::string& path) {
  constexpr std::string_view kPlanner = "planner_svc/";
  if (!path.starts_with(kPlanner)) return "";
  const auto slash = path.find('/', kPlanner.size());
  if (slash == std::string::npos) return "";
  const std::string folder = path.substr(kPlanner.size(), slash - kPlanner.size());
  return folder == "engine" ? "" : folder;
}

}  // namespace

std::vector<std::string> broken_seam_rules(const std::vector<SourceFile>& files) {
  std::vector<std::string> out;
  for (const SourceFile& file : files) {
    if (file.path == kTable) continue;
    for (const std::string& include : file.includes) {
      const std::string engine = engine_of(include);
      if (engine.empty() || engine == engine_of(file.path)) continue;
      out.push_back(file.path + ": includes " + include + "; none but " + kTable +
                    " knows an engine, see planner_svc/engine/");
    }
  }
  return out;
}

std::vector<std::string> broken_planner_rules(const std::vector<SourceFile>& files) {
  std::vector<std::string> out;
  const Reach reach(files);
  for (const SourceFile& file : files) {
    const std::optional<std::string> folder = folder_in_engine(file.path);
    if (!folder) continue;
    if (!is_validator(*folder) && !is_checker(*folder) && !floor_of(*folder))
      out.push_back(file.path + ": stands on no floor; give its folder a place in planner_rules.cpp");
    reach.check(file, *folder, out);
  }
  return out;
}

}  // namespace roci::architecture
