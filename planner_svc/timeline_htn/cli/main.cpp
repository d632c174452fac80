// roci-timelines: roci-timelines check|plan|matrix FILE …
#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <new>
#include <string>

#include "planner_svc/timeline_htn/cli/commands.hpp"

namespace roci::planner::timeline_htn::cli {
namespace {

int run_command_line(int argc, char** argv) {
  CLI::App app("Checks models of hierarchical timelines, and plans with them");
  app.require_subcommand(1);
  app.footer(
      "How a model is written: docs/timeline-format.md. Exit codes: 0 done, 1 the model has errors, 2 wrong "
      "use, 3 no plan, 5 the memory is spent, 6 an external function has no usable value.");
  Files files;
  bool json = false;
  PlanOptions options;
  std::string form = "text";
  std::vector<std::string> resolvers;
  const auto command = [&](const char* name, const char* help) {
    CLI::App* out = app.add_subcommand(name, help);
    out->add_option("FILE", files, "domain, behaviours and problem, in one file or several")->required();
    return out;
  };
  const auto planning = [&](CLI::App* out) {
    static const std::map<std::string, search::Heuristic> heuristics{
        {"blind", search::Heuristic::blind},
        {"relaxed_plan", search::Heuristic::relaxed_plan},
        {"landmarks", search::Heuristic::landmarks}};
    out->add_option_function<std::string>(
           "--heuristic",
           [&options](const std::string& word) { options.resolvers.front().heuristic = heuristics.at(word); },
           "by which the search orders its choices")
        ->check(CLI::IsMember(heuristics));
    out->add_option(
           "--resolvers", resolvers,
           "heuristics that search side by side, the plan of the one with the least work counts; with "
           "_last behind one it tries the last of equal things first")
        ->check(CLI::IsMember(search::resolver_names()));
    out->add_option("--threads", options.threads, "on which they run; the plan is the same for any number")
        ->check(CLI::Range(1, 64));
    out->add_option("--work", options.work, "steps of the search, at most")->capture_default_str();
    out->add_option("--memory", options.megabytes,
                    "limit in MiB of what the searches keep, together; 0: none")
        ->check(CLI::Range(std::size_t{0}, std::size_t{1} << 24U))
        ->capture_default_str();
    out->add_option(
           "--functions", options.functions,
           "values of external functions, which services give in a mission: (traverse_time a b) 12.5")
        ->check(CLI::ExistingFile);
  };
  CLI::App* check_command = command("check", "Tells all that is wrong with it, with file, line and remedy");
  check_command->add_flag("--json", json, "as one JSON object");
  CLI::App* plan_command = command("plan", "Plans, and prints every level of the plan");
  planning(plan_command);
  plan_command->add_flag("--json", json, "as one JSON object");
  CLI::App* matrix_command = command("matrix", "Plans, and prints the values of all timelines by transition");
  planning(matrix_command);
  matrix_command->add_option("--form", form, "text, json or svg")
      ->check(CLI::IsMember({"text", "json", "svg"}));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : wrong_use;
  }
  if (!resolvers.empty()) options.resolvers.clear();
  for (const std::string& name : resolvers) options.resolvers.push_back(*search::resolver_named(name));
  const Output output{std::cout, std::cerr, json};
  try {
    if (*check_command) return check(files, output);
    if (*plan_command) return plan(files, options, output);
    return matrix(files, options, form, output);
  } catch (const std::bad_alloc&) {
    std::cerr << "out_of_memory: the machine has no more; set --memory below what there is\n";
    return out_of_memory;
  }
}

}  // namespace
}  // namespace roci::planner::timeline_htn::cli

int main(int argc, char** argv) { return roci::planner::timeline_htn::cli::run_command_line(argc, argv); }
