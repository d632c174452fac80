#include "tests/scenario/scripted_world/flight.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "exec_svc/journal/journal.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;

// The planetary mission with this world and an executive alone, and plans that an engine sends on its own
// account.
void make_mission(const fs::path& folder, const std::string& more) {
  fs::copy(ROCI_SOURCE_DIR "/missions/planetary", folder, fs::copy_options::recursive);
  std::ostringstream text;
  text << std::ifstream(folder / "mission.yaml").rdbuf();
  std::string mission = text.str();
  const auto replace = [&](const char* what, const std::string& by) {
    mission = std::regex_replace(mission, std::regex(what), by);
  };
  replace("  - \\{name: (planner|pathplan|arm|science)_svc.*\\}\n", "");
  replace("name: sim_svc, clock: master",
          "name: sim_svc, program: " ROCI_BINARY_DIR "/tests/scripted-world, clock: master");
  replace("engine: temporal_pddl", "engine: scripted");
  replace("\nexecutive:\n", "\nexecutive:\n  replanning: continuous\n");
  std::ofstream(folder / "mission.yaml") << mission << more;
}

void read_line(std::istringstream& words, ScriptedFlight& out) {
  std::string time, what, first, second;
  words >> time >> what >> first >> second;
  const auto number_after = [&](const std::string& key) {
    for (std::string word = second;;) {
      if (word.starts_with(key)) return word.substr(key.size());
      if (!(words >> word)) return std::string();
    }
  };
  if (what == "decision") out.decisions.push_back(first + " " + number_after("state="));
  if (what == "answered") out.answered.push_back(first + " " + number_after("outcome="));
  if (what == "ordered") out.orders.push_back(first + " " + number_after("stage="));
  if (what != "command") return;
  std::string action, owner, subsystem, command, argument;
  words >> action >> owner >> subsystem >> command >> argument;
  if (action == "action=0" && command == "image")
    out.images.push_back(argument.substr(argument.find('=') + 1));
}

}  // namespace

long ScriptedFlight::count(const std::string& code) const {
  return std::ranges::count_if(events,
                               [&](const std::string& event) { return event.starts_with(code + " "); });
}

ScriptedFlight fly_scripted(const std::string& environment, const std::string& more,
                            const std::string& mission_more) {
  const fs::path folder = fs::temp_directory_path() / ("roci_scripted_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  make_mission(folder / "mission", mission_more);
  const Ended ended =
      run(environment + " roci-launch " + (folder / "mission").string() +
          " --speed max --headless --json --run-folder " + (folder / "run").string() + " " + more);
  ScriptedFlight out;
  out.exit_code = ended.exit_code;
  out.summary = last_line_as_json(ended.output);
  const fs::path journal = folder / "run" / out.summary.value("journal", "journal.sqlite");
  out.replayed = last_line_as_json(run("roci replay --json " + journal.string()).output);
  std::ifstream heard(folder / "run" / "heard.json");
  out.heard = nlohmann::json::parse(heard, nullptr, false);
  if (fs::exists(journal)) {
    exec::journal::Journal(journal, exec::journal::Durability::process)
        .for_each([&](temporal::Time, std::string_view kind, std::string_view text) {
          if (kind == "event") out.events.emplace_back(text);
          std::istringstream words{std::string(text)};
          if (kind == "trace") read_line(words, out);
        });
  }
  fs::remove_all(folder);
  return out;
}

}  // namespace roci::scenario
