// roci-plan DOMAIN PROBLEM [--time S | --cpu-time S] [--evaluations N] [--memory MB] [--functions FILE]
//           [--functions-mode MODE] [--remaining PLAN] [--stats FILE] [--json] [--seed N] [--progress] [--gantt FILE]
// roci-plan DOMAIN PROBLEM --parse-only [--strict]
//
// The plan goes to standard output, what is wrong to standard error, the verdict into the exit code
// (docs/exit-codes.md).
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <new>

#include "planner_svc/temporal_pddl/cli/arguments.hpp"
#include "planner_svc/temporal_pddl/cli/checked_result.hpp"
#include "planner_svc/temporal_pddl/cli/gantt.hpp"
#include "planner_svc/temporal_pddl/cli/planning.hpp"
#include "planner_svc/temporal_pddl/cli/read_model.hpp"
#include "planner_svc/temporal_pddl/cli/result_json.hpp"

namespace roci::planner::temporal_pddl::cli {

namespace {

using temporal::Verdict;

volatile std::sig_atomic_t interrupted = 0;

// The engine counts its large tables and ends in time; this holds for all else, too.
void limit_memory(std::size_t megabytes) {
  const rlimit limit{megabytes << 20, megabytes << 20};
  setrlimit(RLIMIT_DATA, &limit);
}

// What reading the two files has to say, one line each.
struct Findings {
  std::vector<std::string> warnings;
  std::vector<std::string> errors;
};

std::vector<std::string> lines_of(const std::vector<pddl::Diagnostic>& findings) {
  std::vector<std::string> lines;
  for (const pddl::Diagnostic& finding : findings) lines.push_back(pddl::to_string(finding));
  return lines;
}

// Warnings are told before the planning, which may take long.
Model read(const Arguments& arguments, Findings& findings) {
  const auto strictness = arguments.strict ? pddl::Strictness::strict : pddl::Strictness::tolerant;
  try {
    Model model = read_model(arguments.domain, arguments.problem, strictness);
    findings.warnings = lines_of(warnings_of(model));
    for (const std::string& warning : findings.warnings) std::cerr << warning << '\n';
    return model;
  } catch (const ModelRefused& refused) {
    findings.errors = lines_of(refused.findings());
    throw;
  }
}

// The findings stand in front of what planning has added.
void add_findings(const Findings& findings, nlohmann::json& statistics) {
  nlohmann::json warnings = findings.warnings;
  for (const nlohmann::json& other : statistics["warnings"]) warnings.push_back(other);
  statistics["warnings"] = std::move(warnings);
  if (!findings.errors.empty()) statistics["errors"] = findings.errors;
}

Result refused(const ModelRefused& why) {
  Result result;
  result.verdict = why.verdict();
  result.reason = why.what();
  if (why.findings().size() > 1)
    result.reason = std::to_string(why.findings().size()) + " findings\n" + result.reason;
  return result;
}

// Ends --parse-only where there is nothing to refuse.
int tell_readable(const Arguments& arguments, const Findings& findings) {
  if (arguments.json) std::cout << nlohmann::json{{"warnings", findings.warnings}}.dump(2) << '\n';
  return 0;
}

int run(const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::function<bool()> out_of_time;
  if (arguments.seconds > 0) out_of_time = [&] { return elapsed() > arguments.seconds; };
  if (arguments.processor_seconds > 0)
    out_of_time = [&] {
      return static_cast<double>(std::clock()) / CLOCKS_PER_SEC > arguments.processor_seconds;
    };

  if (arguments.megabytes > 0) limit_memory(arguments.megabytes);
  Result result;
  std::string printed;
  Findings findings;
  try {
    const Model model = read(arguments, findings);
    if (arguments.parse_only) return tell_readable(arguments, findings);
    result = plan(arguments, model, out_of_time, [] { return interrupted != 0; });
    printed = check(model.domain, model.problem, result);
  } catch (const ModelRefused& why) {
    result = refused(why);
  } catch (const pddl::ParseError& error) {
    result.verdict = Verdict::invalid_input;
    result.reason = error.what();
  } catch (const std::bad_alloc&) {
    result.verdict = Verdict::out_of_memory;
    result.reason = "the model itself takes more than the memory limit";
  }
  for (const std::string& warning : result.warnings) std::cerr << warning << '\n';
  if (!arguments.gantt.empty() && result.plan) {
    std::ofstream file(arguments.gantt);
    if (!(file << to_svg(*result.plan, arguments.problem)))
      std::cerr << arguments.gantt << ": cannot be written\n";
  }
  nlohmann::json statistics = statistics_json(result, elapsed());
  add_findings(findings, statistics);
  if (!arguments.stats.empty()) {
    std::ofstream file(arguments.stats);
    if (!(file << statistics.dump(2) << '\n')) std::cerr << arguments.stats << ": cannot be written\n";
  }
  if (arguments.json) {
    nlohmann::json all = statistics;
    if (result.plan) all["plan"] = plan_json(*result.plan);
    std::cout << all.dump(2) << '\n';
  } else {
    std::cout << printed;
  }
  if (!result.plan) std::cerr << name_of(result.verdict) << ": " << result.reason << '\n';
  return exit_code(result.verdict);
}

int run_command_line(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Plans: temporal PDDL domain and problem to a first plan; the exit code is the verdict");
  add_options(app, arguments);
  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
  try {
    app.parse(argc, argv);
    return run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::cli

int main(int argc, char** argv) { return roci::planner::temporal_pddl::cli::run_command_line(argc, argv); }
