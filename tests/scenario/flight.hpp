// Whole missions flown by the programs that users start.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace roci::scenario {

struct Ended {
  int exit_code = -1;
  std::string output;  // standard output; standard error goes to the test's own
};

// Runs a shell command line with the build's bin folder, or ROCI_BIN if that is set, first in PATH.
Ended run(const std::string& command);

// An empty object if the last line is none.
nlohmann::json last_line_as_json(const std::string& output);

// Of a script that prints "name<TAB>exit code<TAB>output" for each step.
struct Step {
  int exit_code = -1;
  nlohmann::json printed;  // discarded if it was no JSON
};
std::map<std::string, Step> steps_of(const std::string& output);

// Flies the mission to its end with `roci-launch … --speed max --headless --json`; the summary is the last
// line. A flight that prints none gives an empty object.
struct Flight {
  int exit_code = -1;
  nlohmann::json summary;
};
Flight fly(const std::string& mission, const std::string& dds, std::uint64_t seed = 1,
           const std::string& more = "");

// Flies the mission over inproc and returns the trace, with which that of a flight over DDS is compared. It is flown
// for each comparison: CTest starts a process for each test, in which no other test leaves a trace behind.
std::string reference_trace(const std::string& mission, const std::string& more = "");

std::string text_of(const std::filesystem::path& file);

// Replaces the first place of `right` in a file; a test fails where it does not stand there.
void edit(const std::filesystem::path& file, const std::string& right, const std::string& wrong);

// What was really done in a run, in its order: "dig near" for each line of its effects.jsonl.
std::vector<std::string> deeds_of(const std::filesystem::path& run_folder);

// "code text" of each event of an executive, as its journal has them.
std::vector<std::string> journaled_events(const std::filesystem::path& journal);

}  // namespace roci::scenario
