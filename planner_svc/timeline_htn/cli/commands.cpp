#include "planner_svc/timeline_htn/cli/commands.hpp"

#include <fstream>
#include <iomanip>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>

#include "core/mission/finding_json.hpp"
#include "core/mission/finding_report.hpp"
#include "core/pddl/source.hpp"
#include "core/temporal/execution_windows.hpp"
#include "planner_svc/engine/function_words.hpp"
#include "planner_svc/engine/table_functions.hpp"
#include "planner_svc/timeline_htn/extraction/matrix.hpp"
#include "planner_svc/timeline_htn/extraction/plan_of.hpp"
#include "planner_svc/timeline_htn/model/check.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"
#include "planner_svc/timeline_htn/request/asked_numbers.hpp"

namespace roci::planner::timeline_htn::cli {

using mission::Findings;
using model::Model;
using temporal::FlexiblePlan, temporal::PlanActivity;

namespace {

std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string seconds(temporal::Duration time) {
  if (!temporal::bounded(time)) return "-";
  std::ostringstream out;
  out << temporal::to_seconds(time);
  return out.str();
}

std::optional<Model> load(const Files& files, const Output& output) {
  Findings findings;
  auto model = reading::load_model(files, findings);
  output.errors << mission::report(findings);
  if (model && !model->problem) {
    output.errors << files.front().string()
                  << ": there is no problem in it; name the file that has one, too\n";
    return std::nullopt;
  }
  return model;
}

/// Is why there is no plan.
struct NoPlan {
  const char* verdict;
  std::string reason;
  ExitCode code = unsolved;
};

// Where services gave no value that is proved by what they proved, or is not proved.
NoPlan unsolvable(const std::string& reason, const std::vector<engine::FunctionUse>& uses) {
  const std::string doubt = engine::doubt_of(uses), denial = engine::denial_of(uses);
  if (!doubt.empty()) return {"timeout", doubt + "; without that, " + reason};
  return {"unsolvable", denial.empty() ? reason : reason + "; " + denial};
}

NoPlan why_not(const search::Resolution& resolution, const std::vector<engine::FunctionUse>& uses,
               const PlanOptions& options) {
  const std::string reason = resolution.search->reason();
  switch (resolution.outcome) {
    case search::Outcome::exhausted:
      return unsolvable(reason, uses);
    case search::Outcome::out_of_memory:
      return {"out_of_memory",
              "the searches have kept all of --memory " + std::to_string(options.megabytes) +
                  " MiB; give them more, fewer resolvers or another heuristic; so far: " + reason,
              out_of_memory};
    case search::Outcome::cancelled:
      return {"cancelled", reason};
    default:
      return {"timeout",
              "no plan was found in --work " + std::to_string(options.work) + " steps; so far: " + reason};
  }
}

ExitCode tell(const NoPlan& why, const Output& output) {
  if (output.json) {
    const nlohmann::ordered_json json = {{"verdict", why.verdict}, {"reason", why.reason}};
    output.out << json.dump(2) << '\n';
  } else {
    output.errors << why.verdict << ": " << why.reason << '\n';
  }
  return why.code;
}

request::Asked ask(Model& model, const std::filesystem::path& file) {
  std::unique_ptr<engine::FunctionSource> functions = std::make_unique<engine::NoFunctions>();
  if (!file.empty()) {
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    functions = std::make_unique<engine::TableFunctions>(pddl::parse_function_tables(text, file.string()),
                                                         file.string());
  }
  return request::ask_numbers(model, *functions, [] { return false; });
}

/// Is a plan, or the exit code with which its lack was told.
struct Solved {
  ExitCode code = done;
  FlexiblePlan plan{};
  search::Count count{};
};

// Plans, and tells why not where there is no plan.
Solved solve(Model& model, const PlanOptions& options, const Output& output) {
  request::Asked asked;
  try {
    asked = ask(model, options.functions);
  } catch (const pddl::ParseError& error) {
    return {tell({"invalid_input", error.what(), faulty}, output)};
  }
  if (asked.verdict != temporal::Verdict::solved)
    return {tell({to_string(asked.verdict), asked.reason,
                  asked.verdict == temporal::Verdict::function_unavailable ? no_functions : faulty},
                 output)};
  for (const model::Fault& fault : model::check(model))  // of what stands on these numbers
    if (!fault.warning) return {tell(unsolvable(fault.what + "; " + fault.remedy, asked.uses), output)};
  const search::Resolution resolution =
      search::resolve(model, options.resolvers, options.threads, options.work, options.megabytes << 20U,
                      [] { return false; });
  if (resolution.outcome != search::Outcome::solved)
    return {tell(why_not(resolution, asked.uses, options), output)};
  return {done, extraction::plan_of(*resolution.search, {"plan", "a", temporal::Time{0}}),
          resolution.search->count()};
}

std::size_t depth_of(const FlexiblePlan& plan, const PlanActivity& activity) {
  std::size_t depth = 0;
  for (const PlanActivity* one = &activity; !one->parent.empty(); ++depth)
    one = &*std::ranges::find(plan.activities, one->parent, &PlanActivity::id);
  return depth;
}

void print_tree(const FlexiblePlan& plan, const temporal::ExecutionWindows& windows,
                const std::string& parent, std::ostream& out) {
  std::vector<const PlanActivity*> children;
  for (const PlanActivity& activity : plan.activities)
    if (activity.parent == parent) children.push_back(&activity);
  std::ranges::stable_sort(children, {},
                           [&](const PlanActivity* one) { return windows.window(one->start_point).lower; });
  for (const PlanActivity* one : children) {
    const auto start = windows.window(one->start_point), end = windows.window(one->end_point);
    out << std::string(2 * depth_of(plan, *one), ' ') << one->name << "  [" << seconds(start.lower) << ", "
        << seconds(start.upper) << "] to [" << seconds(end.lower) << ", " << seconds(end.upper) << "]";
    if (!one->owner.empty()) out << "  " << one->owner << "/" << one->command_name;
    out << '\n';
    print_tree(plan, windows, one->id, out);
  }
}

nlohmann::ordered_json json_of(const FlexiblePlan& plan, const temporal::ExecutionWindows& windows) {
  auto activities = nlohmann::ordered_json::array();
  for (const PlanActivity& one : plan.activities) {
    const auto start = windows.window(one.start_point), end = windows.window(one.end_point);
    activities.push_back({{"id", one.id},
                          {"name", one.name},
                          {"level", one.level},
                          {"parent", one.parent},
                          {"owner", one.owner},
                          {"command", one.command_name},
                          {"start_s", {temporal::to_seconds(start.lower), temporal::to_seconds(start.upper)}},
                          {"end_s", {temporal::to_seconds(end.lower), temporal::to_seconds(end.upper)}},
                          {"goals", one.goals_served}});
  }
  auto decisions = nlohmann::ordered_json::array();
  for (const auto& one : plan.decisions) {
    auto choices = nlohmann::ordered_json::array();
    for (const auto& choice : one.choices)
      choices.push_back({{"name", choice.name}, {"activities", choice.activities}});
    decisions.push_back({{"id", one.id}, {"choices", choices}, {"admissible", one.admissible}});
  }
  return {{"activities", activities}, {"decisions", decisions}};
}

// What is known to come of a component: the state in which it begins, and each later one with its time.
std::vector<model::PredictedState> predicted_states(const Model& model, model::Index component) {
  std::vector<model::PredictedState> out{{temporal::Duration{0}, *model.problem->initial[component]}};
  for (const model::PredictedState& one : *model.problem->predicted[component])
    if (one.at < model.problem->horizon) out.push_back(one);
  return out;
}

void print_predicted(const Model& model, std::ostream& out) {
  for (model::Index c = 0; c < model.components.size(); ++c) {
    if (!model::is_predicted(model, c)) continue;
    out << "predicted:";
    for (const model::PredictedState& one : predicted_states(model, c))
      out << (one.at == temporal::Duration{0} ? " " : ", ") << to_text(model, one.state, {}) << " ["
          << seconds(one.at) << "]";
    out << '\n';
  }
}

nlohmann::ordered_json predicted_json(const Model& model) {
  auto out = nlohmann::ordered_json::object();
  for (model::Index c = 0; c < model.components.size(); ++c)
    if (model::is_predicted(model, c))
      for (const model::PredictedState& one : predicted_states(model, c))
        out[model.components[c].name].push_back(
            {{"at_s", temporal::to_seconds(one.at)}, {"state", to_text(model, one.state, {})}});
  return out;
}

}  // namespace

ExitCode check(const Files& files, const Output& output) {
  Findings findings;
  const auto model = reading::load_model(files, findings);
  const std::size_t errors = findings.errors(), warnings = findings.size() - errors;
  if (output.json) {
    const nlohmann::ordered_json json = {{"usable", model.has_value()},
                                         {"errors", errors},
                                         {"warnings", warnings},
                                         {"findings", to_json(findings)}};
    output.out << json.dump(2) << '\n';
    return model ? done : faulty;
  }
  output.out << mission::report(findings);
  if (!model) {
    output.out << counted(errors, "error") << ", " << counted(warnings, "warning") << '\n';
    return faulty;
  }
  output.out << "domain '" << model->name << "': " << counted(model->components.size(), "component") << ", "
             << counted(model->behaviours.size(), "behaviour") << ", "
             << counted(model->objects.size(), "object") << ", "
             << (model->problem ? counted(model->problem->goals.size(), "goal") : "no problem")
             << "; no error, " << counted(warnings, "warning") << '\n';
  return done;
}

ExitCode plan(const Files& files, const PlanOptions& options, const Output& output) {
  auto model = load(files, output);
  if (!model) return faulty;
  const auto [code, plan, count] = solve(*model, options, output);
  if (code != done) return code;
  temporal::ExecutionWindows windows(plan.point_count, temporal::all_constraints(plan),
                                     temporal::Duration{0});
  windows.settle();
  if (output.json) {
    nlohmann::ordered_json json = {{"verdict", "solved"}};
    json["statistics"] = {{"expanded", count.expanded},
                          {"evaluated", count.evaluated},
                          {"refused", count.refused},
                          {"repeated", count.repeated},
                          {"bytes", count.bytes}};
    json.update(json_of(plan, windows));
    if (auto predicted = predicted_json(*model); !predicted.empty()) json["predicted"] = std::move(predicted);
    output.out << json.dump(2) << '\n';
    return done;
  }
  print_tree(plan, windows, "", output.out);
  print_predicted(*model, output.out);
  for (const auto& decision : plan.decisions) {
    output.out << "decision " << decision.id << " before "
               << seconds(windows.window(decision.decide_before).upper) << " s:";
    for (const auto& choice : decision.choices) output.out << ' ' << choice.name;
    for (const auto& value : decision.admissible) output.out << ' ' << value;
    output.out << '\n';
  }
  output.errors << plan.activities.size() << " activities"
                << ", " << counted(plan.tokens.size(), "value") << "; expanded " << count.expanded
                << ", evaluated " << count.evaluated << ", refused " << count.refused << ", repeated "
                << count.repeated << ", bytes " << count.bytes << '\n';
  return done;
}

ExitCode matrix(const Files& files, const PlanOptions& options, const std::string& form,
                const Output& output) {
  auto model = load(files, output);
  if (!model) return faulty;
  const Solved solved = solve(*model, options, output);
  if (solved.code != done) return solved.code;
  const extraction::Matrix matrix = extraction::matrix_of(solved.plan);
  if (form == "json") {
    output.out << to_json(matrix) << '\n';
  } else {
    output.out << (form == "svg" ? to_svg(matrix, model->name) : to_text(matrix));
  }
  return done;
}

}  // namespace roci::planner::timeline_htn::cli
