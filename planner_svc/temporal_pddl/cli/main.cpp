// roci-plan DOMAIN PROBLEM [--time S | --cpu-time S] [--evaluations N] [--memory MB] [--functions FILE]
//           [--functions-mode MODE] [--remaining PLAN] [--stats FILE] [--json] [--seed N] [--progress] [--gantt FILE]
// roci-plan DOMAIN PROBLEM --parse-only [--strict]
//
// The plan goes to standard output, what is wrong to standard error, the verdict into the exit code
// (docs/exit-codes.md).
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "planner_svc/temporal_pddl/cli/checked_result.hpp"
#include "planner_svc/temporal_pddl/cli/gantt.hpp"
#include "planner_svc/temporal_pddl/cli/progress_line.hpp"
#include "planner_svc/temporal_pddl/cli/read_model.hpp"
#include "planner_svc/temporal_pddl/cli/table_functions.hpp"
#include "planner_svc/temporal_pddl/extraction/plan_text.hpp"
#include "planner_svc/temporal_pddl/planner.hpp"

namespace roci::planner::temporal_pddl::cli {

using engine::FunctionSource, engine::NoFunctions;

namespace {

using call::Budget;
using call::Monitor;
using call::Options;
using call::Statistics;
using call::WindowExtraction;
using extraction::Plan;
using extraction::to_ipc;
using temporal::Verdict;

constexpr int kDefect = 8;
constexpr int kUsageError = 64;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // its shadow memory is more than any limit
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

// 4 GiB, or three quarters of a smaller machine's memory.
std::size_t default_megabytes() {
  constexpr std::size_t kMost = 4096;
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  if (kSanitized) return 0;
  if (pages <= 0 || bytes <= 0) return kMost;
  return std::min(kMost, (static_cast<std::size_t>(pages) * static_cast<std::size_t>(bytes) >> 20) / 4 * 3);
}

struct Arguments {
  std::string domain, problem, functions, stats, remaining, gantt;
  std::string functions_mode = "eager";
  double seconds = 0;                           // 0: no limit
  double processor_seconds = 0;                 // 0: no limit
  std::size_t megabytes = default_megabytes();  // 0: no limit
  std::size_t evaluations = 0;                  // 0: no limit
  std::uint64_t seed = 0;
  std::size_t improve = 0;
  bool strict = false;
  bool parse_only = false;
  bool json = false;
  bool plain_search = false;
  bool progress = false;
};

volatile std::sig_atomic_t interrupted = 0;

int exit_code(Verdict verdict) {
  switch (verdict) {
    case Verdict::solved:
      return 0;
    case Verdict::unsolvable:
      return 1;
    case Verdict::invalid_input:
      return 2;
    case Verdict::unsupported:
      return 3;
    case Verdict::timeout:
      return 4;
    case Verdict::out_of_memory:
      return 5;
    case Verdict::function_unavailable:
      return 6;
    case Verdict::cancelled:
      return 7;
    case Verdict::crashed:
      return kDefect;
    case Verdict::no_reply:
      break;  // the engine does not say this of itself
  }
  return kUsageError;
}

// The engine counts its large tables and ends in time; this holds for all else, too.
void limit_memory(std::size_t megabytes) {
  const rlimit limit{megabytes << 20, megabytes << 20};
  setrlimit(RLIMIT_DATA, &limit);
}

double seconds(temporal::Duration duration) { return std::chrono::duration<double>(duration).count(); }

// A verdict as roci-plan tells it: what went wrong inside it is its own defect.
std::string name_of(Verdict verdict) {
  return verdict == Verdict::crashed ? "internal error" : std::string(temporal::to_string(verdict));
}

nlohmann::json statistics_json(const Result& result, double wall_s) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const Statistics& statistics = result.statistics;
  return {{"verdict", name_of(result.verdict)},
          {"reason", result.reason},
          {"warnings", result.warnings},
          {"makespan", result.plan ? nlohmann::json(seconds(result.plan->makespan)) : nlohmann::json()},
          {"metric", result.plan ? nlohmann::json(result.plan->metric) : nlohmann::json()},
          {"actions", result.plan ? nlohmann::json(result.plan->activities.size()) : nlohmann::json()},
          {"wall_s", wall_s},
          {"peak_rss_kb", usage.ru_maxrss},
          {"expanded", statistics.expanded},
          {"evaluated", statistics.evaluated},
          {"generated", statistics.generated},
          {"temporally_inconsistent", statistics.temporally_inconsistent},
          {"dominated", statistics.dominated},
          {"hopeless", statistics.dead_ends},
          {"function_requests", statistics.function_requests},
          {"exact_values", statistics.exact_values},
          {"cheap_values", statistics.cheap_values},
          {"rounds", statistics.rounds},
          {"exhausted", statistics.exhausted},
          {"bytes_per_state", statistics.bytes_per_state},
          {"from_remaining", statistics.from_remaining},
          {"engine_peak_bytes", statistics.peak_bytes},
          {"facts", statistics.facts},
          {"variables", statistics.variables},
          {"numeric_variables", statistics.numeric_variables},
          {"ground_actions", statistics.actions}};
}

nlohmann::json plan_json(const Plan& plan) {
  auto activities = nlohmann::json::array();
  for (const auto& activity : plan.activities) {
    const auto& start = plan.network.points[activity.start_point];
    nlohmann::json entry = {{"name", activity.name},
                            {"arguments", activity.arguments},
                            {"start", seconds(activity.start)},
                            {"duration", seconds(activity.end - activity.start)},
                            {"earliest_start", seconds(start.earliest)}};
    if (start.latest != temporal::no_bound) entry["latest_start"] = seconds(start.latest);
    activities.push_back(std::move(entry));
  }
  return activities;
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

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
}

Result plan(const Arguments& arguments, const Model& model, const std::function<bool()>& out_of_time) {
  std::optional<ProgressLine> line;
  if (arguments.progress || isatty(STDERR_FILENO) != 0)
    line.emplace(std::cerr, ProgressLine::Clock::now(), terminal_columns());
  std::unique_ptr<FunctionSource> functions = std::make_unique<NoFunctions>();
  if (!arguments.functions.empty()) {
    functions = std::make_unique<TableFunctions>(
        pddl::parse_function_tables(read_file(arguments.functions), arguments.functions),
        arguments.functions);
  }
  Budget budget;
  budget.out_of_time = out_of_time;
  if (arguments.megabytes > 0) budget.memory_bytes = arguments.megabytes << 20;
  if (arguments.evaluations > 0) budget.evaluations = arguments.evaluations;
  Monitor monitor;
  monitor.cancelled = [] { return interrupted != 0; };
  if (line) monitor.watch = [&](const call::Progress& progress) { line->show(progress); };
  Options options;
  options.seed = arguments.seed;
  if (arguments.plain_search) {
    options.compression_safety = false;
    options.dominance = false;
    options.windows = WindowExtraction::none;
  }
  options.functions = *engine::functions_mode_named(arguments.functions_mode);
  options.describe_activities = false;
  options.improvement_evaluations = arguments.improve;
  if (arguments.seconds + arguments.processor_seconds > 0 && arguments.improve == 0)
    options.improvement_evaluations = std::numeric_limits<std::size_t>::max();
  std::vector<pddl::PlanStep> remaining;
  if (!arguments.remaining.empty())
    remaining = pddl::parse_plan(read_file(arguments.remaining), arguments.remaining);
  Result result =
      temporal_pddl::plan(model.domain, model.problem, *functions, budget, monitor, options, remaining);
  check(model.domain, model.problem, result);
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
  Findings findings;
  try {
    const Model model = read(arguments, findings);
    if (arguments.parse_only) return tell_readable(arguments, findings);
    result = plan(arguments, model, out_of_time);
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
  } else if (result.plan) {
    std::cout << to_ipc(*result.plan);
  }
  if (!result.plan) std::cerr << name_of(result.verdict) << ": " << result.reason << '\n';
  return exit_code(result.verdict);
}

int run_command_line(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Plans: temporal PDDL domain and problem to a first plan; the exit code is the verdict");
  app.add_option("DOMAIN", arguments.domain)->required();
  app.add_option("PROBLEM", arguments.problem)->required();
  app.add_option("--time", arguments.seconds,
                 "limit in seconds of wall time; spent on better plans to its end");
  app.add_option("--cpu-time", arguments.processor_seconds, "as --time, in seconds of processor time")
      ->excludes("--time");
  app.add_option("--improve", arguments.improve, "look for better plans with so many evaluations");
  app.add_option("--evaluations", arguments.evaluations,
                 "limit in heuristic evaluations until the first plan; 1: what grounding costs");
  app.add_option(
         "--memory", arguments.megabytes,
         "limit in MiB of all data of the process; 0: none; if not given, 4096 or three quarters of the "
         "machine's memory, whatever is less")
      ->capture_default_str();
  app.add_option("--functions", arguments.functions,
                 "values of external functions: (traverse_time a b) 12.5");
  app.add_option(
         "--functions-mode", arguments.functions_mode,
         "which of these are asked for: eager (all), lazy (what searches touch) or two-accuracy (exact "
         "ones for candidate plans, else lower bounds: (traverse_time a b) >= 10)")
      ->check(CLI::IsMember({"eager", "lazy", "two-accuracy"}))
      ->capture_default_str();
  app.add_option("--remaining", arguments.remaining, "what is left of an earlier plan, to begin with");
  app.add_option("--stats", arguments.stats, "write statistics as JSON to this file");
  app.add_flag("--strict", arguments.strict,
               "refuse what departs from PDDL instead of reading it with a warning");
  app.add_flag("--parse-only", arguments.parse_only,
               "read and check both files, tell what is wrong with them, and end");
  app.add_option("--gantt", arguments.gantt, "draw the plan into this file, as SVG");
  app.add_flag("--progress", arguments.progress,
               "tell on standard error what it is doing, as it does by itself on a terminal");
  app.add_flag("--json", arguments.json, "plan and statistics as one JSON object");
  app.add_flag(
      "--plain-search", arguments.plain_search,
      "no dominance check, no compressed actions, timed literals as steps: slower, the same verdicts");
  app.add_option("--seed", arguments.seed, "order among equally good successors; 0: as generated");
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
