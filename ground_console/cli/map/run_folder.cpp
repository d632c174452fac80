#include "ground_console/cli/map/run_folder.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::map {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read_json(const fs::path& file) {
  std::ifstream in(file);
  return in ? json::parse(in, nullptr, false) : json();
}

std::optional<double> number_at(const json& object, const char* key) {
  const bool there = object.is_object() && object.contains(key) && object[key].is_number();
  return there ? std::optional(object[key].get<double>()) : std::nullopt;
}

std::string text_at(const json& object, const char* key) {
  const bool there = object.is_object() && object.contains(key) && object[key].is_string();
  return there ? object[key].get<std::string>() : "";
}

// What `roci-trace print OPTIONS` says; nothing if it fails. Why it does stands on standard error unless it is `quiet`.
std::optional<std::string> printed(const std::vector<std::string>& options, bool quiet) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "roci-trace";
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  if (quiet) posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::vector<std::string> words{program.string(), "print"};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_t pid = 0;
  const int failed = posix_spawn(&pid, pointers.front(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  std::string out;
  std::array<char, 65536> buffer{};
  for (ssize_t count = 0; failed == 0 && (count = read(pipe_ends[0], buffer.data(), buffer.size())) > 0;)
    out.append(buffer.data(), static_cast<std::size_t>(count));
  close(pipe_ends[0]);
  int status = 1;
  if (failed != 0 || waitpid(pid, &status, 0) != pid || status != 0) return std::nullopt;
  return out;
}

std::optional<std::string> trace_of_one(const fs::path& run) {
  auto out = printed({"--decisions", run.string()}, true);
  return out ? out : printed({run.string()}, false);
}

// The journals of a run with several executives; none where one alone commands.
std::vector<fs::path> journals_of_several(const fs::path& run) {
  std::vector<fs::path> out;
  const json summary = read_json(run / "summary.json");
  if (!summary.is_object() || !summary.contains("executives") || !summary["executives"].is_object())
    return out;
  for (const auto& [name, own] : summary["executives"].items())
    if (const std::string journal = text_at(own, "journal"); !journal.empty())
      out.push_back(run / fs::path(journal).filename());
  return out;
}

std::int64_t time_of(const std::string& line) { return std::strtoll(line.c_str(), nullptr, 10); }

// The lines of all in the order of their times; what several have heard stands once.
std::string merged(const std::vector<std::string>& traces) {
  std::vector<std::string> lines;
  std::set<std::string> heard;
  for (const std::string& trace : traces) {
    std::istringstream in(trace);
    for (std::string line; std::getline(in, line);) {
      const bool observed = line.find(" observation ") != std::string::npos;
      if (!observed || heard.insert(line).second) lines.push_back(std::move(line));
    }
  }
  std::ranges::stable_sort(lines, {}, time_of);
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  return out;
}

}  // namespace

std::optional<std::string> trace_of(const fs::path& run) {
  const auto journals = journals_of_several(run);
  if (journals.empty()) return trace_of_one(run);
  std::vector<std::string> traces;
  for (const fs::path& journal : journals) {
    auto trace = trace_of_one(journal);
    if (!trace) return std::nullopt;
    traces.push_back(std::move(*trace));
  }
  return merged(traces);
}

fs::path mission_of(const fs::path& run) {
  const json launch = read_json(run / "launch.json");
  if (launch.is_object() && launch.contains("arguments") && launch["arguments"].is_array() &&
      !launch["arguments"].empty() && launch["arguments"][0].is_string())
    return launch["arguments"][0].get<std::string>();
  throw std::invalid_argument(run.string() +
                              " is no run folder that names its mission; see roci runs, or add --mission");
}

std::string words_of_summary(const fs::path& run) {
  const json summary = read_json(run / "summary.json");
  if (!summary.is_object()) return run.filename().string();
  const auto text = [&](const char* key) {
    return summary.contains(key) && summary[key].is_string() ? summary[key].get<std::string>() : "";
  };
  std::string out = "scenario " + text("scenario");
  if (summary.contains("seed") && summary["seed"].is_number_integer())
    out += ", seed " + summary["seed"].dump();
  if (summary.contains("sim_s") && summary["sim_s"].is_number())
    out += ", flown " + lib::clock_text(static_cast<std::int64_t>(summary["sim_s"].get<double>() * 1e6));
  return out + ", " + text("result");
}

std::map<std::string, std::string> map_owners(const mission::ServiceList& list) {
  std::map<std::string, std::string> out;
  std::set<std::string> robots;
  for (const mission::ServiceEntry* one : list.of_program("pathplan_svc")) {
    if (one->robot.empty()) continue;
    out[one->name] = one->robot;
    robots.insert(one->robot);
  }
  return robots.size() > 1 ? out : std::map<std::string, std::string>{};
}

void add_hazards(const fs::path& run, const std::map<std::string, std::string>& owners, MissionMap& map) {
  if (!fs::is_directory(run)) return;
  for (const auto& file : fs::directory_iterator(run)) {
    if (file.path().extension() != ".hazards") continue;
    const json hazards = read_json(file.path());
    if (!hazards.is_array()) continue;
    const auto owner = owners.find(file.path().stem().string());
    for (const json& hazard : hazards) {
      const auto x = number_at(hazard, "x_m"), y = number_at(hazard, "y_m"),
                 radius = number_at(hazard, "radius_m");
      if (!x || !y || !radius || *radius < 0) continue;
      const Circle circle{{*x, *y}, *radius};
      if (std::ranges::find(map.hazards, circle) == map.hazards.end()) map.hazards.push_back(circle);
      if (owner != owners.end())
        map.known[owner->second].push_back(
            {circle, text_at(hazard, "kind"), text_at(hazard, "found_by"), text_at(hazard, "id")});
    }
  }
}

}  // namespace roci::console::cli::map
