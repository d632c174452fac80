#include "planner_svc/temporal_pddl/cli/planning.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/pddl/function_table.hpp"
#include "core/pddl/plan_text.hpp"
#include "planner_svc/engine/table_functions.hpp"
#include "planner_svc/temporal_pddl/cli/progress_line.hpp"
#include "planner_svc/temporal_pddl/planner.hpp"

namespace roci::planner::temporal_pddl::cli {

using call::Budget, call::Monitor, call::Options, call::WindowExtraction;
using engine::FunctionSource, engine::NoFunctions, engine::TableFunctions;

namespace {

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
}

}  // namespace

Result plan(const Arguments& arguments, const Model& model, const std::function<bool()>& out_of_time,
            const std::function<bool()>& interrupted) {
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
  monitor.cancelled = interrupted;
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
  return temporal_pddl::plan(model.domain, model.problem, *functions, budget, monitor, options, remaining);
}

}  // namespace roci::planner::temporal_pddl::cli
