// roci-validate checks a plan: roci-validate DOMAIN PROBLEM PLAN [--functions FILE] [--strict] [--json]
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/pddl/check.hpp"
#include "core/pddl/forbidden.hpp"
#include "planner_svc/temporal_pddl/validate/validator.hpp"

namespace roci::planner::temporal_pddl::validate {
namespace {

enum ExitCode { valid = 0, invalid = 1, unreadable = 2 };

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  if (!file || std::filesystem::is_directory(path, error)) {
    throw pddl::ParseError({path, {}, "cannot be read", "check the path and its permissions"});
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

nlohmann::json to_json(const Report& report, const std::vector<pddl::PlanStep>& plan) {
  const auto seconds = [](pddl::Microseconds time) { return static_cast<double>(time.count()) * 1e-6; };
  nlohmann::json json = {{"valid", report.valid},
                         {"makespan", seconds(report.makespan)},
                         {"violations", nlohmann::json::array()}};
  if (report.metric) json["metric"] = *report.metric;
  for (const Violation& violation : report.violations) {
    nlohmann::json entry = {{"kind", to_string(violation.kind)},
                            {"time", seconds(violation.time)},
                            {"message", violation.message}};
    if (violation.step) {
      entry["step"] = *violation.step;
      entry["line"] = plan[*violation.step].where.line;
      entry["action"] = violation.action;
    }
    if (!violation.condition.empty()) entry["condition"] = violation.condition;
    json["violations"].push_back(std::move(entry));
  }
  return json;
}

struct Arguments {
  std::string domain;
  std::string problem;
  std::string plan;
  std::string functions;
  Options options;
  bool strict = false;
  bool json = false;
};

void tell(const std::vector<pddl::Diagnostic>& warnings) {
  for (const pddl::Diagnostic& warning : warnings) std::cerr << pddl::to_string(warning) << '\n';
}

int run(const Arguments& arguments) {
  const auto strictness = arguments.strict ? pddl::Strictness::strict : pddl::Strictness::tolerant;
  const pddl::Domain domain = pddl::load_domain(read_file(arguments.domain), arguments.domain, strictness);
  tell(domain.warnings);
  const pddl::Problem problem =
      pddl::load_problem(read_file(arguments.problem), arguments.problem, domain, strictness);
  tell(problem.warnings);
  if (auto forbidden = pddl::forbidden_effects(domain, problem); !forbidden.empty()) {
    throw pddl::ParseError(std::move(forbidden));
  }
  const auto plan = pddl::parse_plan(read_file(arguments.plan), arguments.plan);
  pddl::FunctionTable functions;
  if (!arguments.functions.empty()) {
    functions = pddl::parse_function_table(read_file(arguments.functions), arguments.functions);
  }
  const Report report = validate(domain, problem, plan, functions, arguments.options);
  if (arguments.json) {
    std::cout << to_json(report, plan).dump(2) << '\n';
  } else if (report.valid) {
    std::cout << "valid: " << plan.size() << " steps, makespan " << pddl::print_seconds(report.makespan);
    if (report.metric) std::cout << ", metric " << *report.metric;
    std::cout << '\n';
  } else {
    std::cout << to_text(report, plan, arguments.plan);
  }
  return report.valid ? valid : invalid;
}

int run_command_line(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Checks a plan against PDDL 2.2, independently of the planner: 0 valid, 1 invalid, 2 unreadable input");
  app.add_option("DOMAIN", arguments.domain)->required();
  app.add_option("PROBLEM", arguments.problem)->required();
  app.add_option("PLAN", arguments.plan, "steps as 0.001: (drive a b) [12.5]")->required();
  app.add_option("--functions", arguments.functions,
                 "values of external functions: (traverse_time a b) 12.5");
  app.add_flag("--strict", arguments.strict,
               "refuse what departs from PDDL instead of reading it with a warning");
  app.add_flag("--json", arguments.json, "the report as one JSON object");
  try {
    app.parse(argc, argv);
    return run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? valid : unreadable;
  } catch (const pddl::ParseError& error) {
    std::cerr << error.what() << '\n';
    return unreadable;
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::validate

int main(int argc, char** argv) {
  return roci::planner::temporal_pddl::validate::run_command_line(argc, argv);
}
