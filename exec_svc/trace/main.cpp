// roci-trace prints the trace of a run, and compares the traces of two builds. docs/exit-codes.md has its
// exit codes.
#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "exec_svc/trace/comparison.hpp"
#include "exec_svc/trace/report.hpp"
#include "exec_svc/trace/run_reader.hpp"
#include "exec_svc/trace/trace_text.hpp"

namespace {

namespace fs = std::filesystem;
namespace trace = roci::exec::trace;

enum ExitCode { kEqual = 0, kDifferent = 1, kUnreadable = 2 };

struct Options {
  fs::path run;
  fs::path before;
  fs::path after;
  fs::path map;
  std::string scenario;
  bool decisions = false;
  trace::ReportOptions report;
};

trace::RecordedTrace read(const fs::path& run, const Options& options) {
  trace::RecordedTrace out = trace::read_run(run, options.decisions);
  if (!options.scenario.empty()) out.scenario = options.scenario;
  return out;
}

// Reads a run that flew: two runs that never began are not the same run.
trace::RecordedTrace read_flown(const fs::path& run, const Options& options) {
  trace::RecordedTrace out = read(run, options);
  if (out.lines.empty()) throw trace::TraceError(run.string() + " has no line of a trace; fly it again");
  return out;
}

trace::Comparison compare(const fs::path& before, const fs::path& after, const trace::TraceMap& map,
                          const Options& options, std::string& scenario) {
  const trace::RecordedTrace old_trace = read_flown(before, options);
  const trace::RecordedTrace new_trace = read_flown(after, options);
  scenario = old_trace.scenario.empty() ? new_trace.scenario : old_trace.scenario;
  return trace::compare(old_trace, new_trace, map);
}

int compare_one(const trace::TraceMap& map, const Options& options) {
  std::string scenario;
  const trace::Comparison found = compare(options.before, options.after, map, options, scenario);
  std::cout << trace::verdict(found) << "\n"
            << trace::differences(found, options.report)
            << trace::useless_rules(map, found.uses, scenario, false);
  return found.equal() ? kEqual : kDifferent;
}

using Runs = std::map<std::string, fs::path>;

// Compares each run of OLD with the run of the same name of NEW.
int compare_all(const Runs& before, const Runs& after, const trace::TraceMap& map, const Options& options) {
  std::size_t different = 0;
  trace::Uses uses;
  for (const auto& [name, run] : before) {
    const auto partner = after.find(name);
    if (partner == after.end()) {
      ++different;
      std::cout << name << ": only in OLD\n";
      continue;
    }
    std::string scenario;
    const trace::Comparison found = compare(run, partner->second, map, options, scenario);
    for (const auto& [place, count] : found.uses) uses[place] += count;
    different += !found.equal();
    std::cout << name << ": " << trace::verdict(found) << "\n" << trace::differences(found, options.report);
  }
  for (const auto& [name, run] : after) {
    if (before.contains(name)) continue;
    ++different;
    std::cout << name << ": only in NEW\n";
  }
  std::cout << trace::useless_rules(map, uses, "", true);
  std::cout << before.size() << " runs, " << different << " different\n";
  return different == 0 ? kEqual : kDifferent;
}

int compare(const Options& options) {
  const trace::TraceMap map = options.map.empty() ? trace::TraceMap{} : trace::read_map(options.map);
  const Runs before = trace::runs_in(options.before);
  const Runs after = trace::runs_in(options.after);
  if (!before.empty() || !after.empty()) return compare_all(before, after, map, options);
  return compare_one(map, options);
}

int print(const Options& options) {
  trace::print(std::cout, read(options.run, options));
  return kEqual;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Prints the trace of a run, and compares the traces of two builds line by line", "roci-trace");
  app.require_subcommand(1);
  constexpr char kDecisions[] =
      "Take the goals, events, steps and planner calls, too, which the hash leaves out";
  constexpr char kScenario[] = "Scenario of the run (default: what its summary.json says)";
  CLI::App* printing = app.add_subcommand("print", "Prints the lines of the trace with their mission time");
  printing->add_option("run", options.run, "Run folder, journal.sqlite or printed trace")->required();
  printing->add_flag("--decisions", options.decisions, kDecisions);
  printing->add_option("--scenario", options.scenario, kScenario);
  CLI::App* comparing = app.add_subcommand("compare", "Renames OLD as the map says and compares it with NEW");
  comparing->add_option("old", options.before, "A run, or a folder of runs")->required();
  comparing->add_option("new", options.after, "The same of the other build")->required();
  comparing->add_option("--map", options.map, "The committed renaming (exec_svc/trace/README.md)");
  comparing->add_flag("--decisions", options.decisions, kDecisions);
  comparing->add_option("--scenario", options.scenario, kScenario);
  comparing->add_option("--show", options.report.shown, "So many differences of a run")
      ->capture_default_str();
  comparing->add_option("--context", options.report.context, "So many lines before each")
      ->capture_default_str();
  comparing->add_option("--width", options.report.width, "Of shown lines, in characters")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kEqual : kUnreadable;
  }
  try {
    return printing->parsed() ? print(options) : compare(options);
  } catch (const std::exception& error) {
    std::cerr << "roci-trace: " << error.what() << "\n";
    return kUnreadable;
  }
}
