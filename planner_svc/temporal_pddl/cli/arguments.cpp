#include "planner_svc/temporal_pddl/cli/arguments.hpp"

#include <unistd.h>

#include <algorithm>

namespace roci::planner::temporal_pddl::cli {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // its shadow memory is more than any limit
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

}  // namespace

std::size_t default_megabytes() {
  constexpr std::size_t kMost = 4096;
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  if (kSanitized) return 0;
  if (pages <= 0 || bytes <= 0) return kMost;
  return std::min(kMost, (static_cast<std::size_t>(pages) * static_cast<std::size_t>(bytes) >> 20) / 4 * 3);
}

void add_options(CLI::App& app, Arguments& arguments) {
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
}

}  // namespace roci::planner::temporal_pddl::cli
