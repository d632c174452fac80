#include "rehearsal/check/dry_plan.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>
#include <variant>

#include "core/pddl/ast.hpp"
#include "core/words/nearest_word.hpp"
#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/mission/template_text.hpp"
#include "exec_svc/problem/problem_writer.hpp"
#include "planner_svc/engine/checked_answer.hpp"
#include "planner_svc/engines.hpp"
#include "rehearsal/check/scenario_check.hpp"
#include "rehearsal/check/words.hpp"
#include "services/clock/wall.hpp"
#include "sim_svc/world/world.hpp"

namespace roci::rehearsal::check {

using exec::goals::GoalRequest, exec::goals::GoalSet, exec::goals::GoalState;
using exec::mission::GoalKind, exec::mission::MissionModel;
using planner::engine::Answer, planner::engine::Request;
using sim::scenario::GoalStimulus;
using temporal::Verdict;

namespace {

constexpr std::size_t kTries = 3;                         // goals of a kind
constexpr std::uint64_t kWork = 20000;                    // evaluations, for a mission without a budget
constexpr auto kPlanningTime = std::chrono::seconds(20);  // of wall time, for one plan

// A goal of a scenario, with those that its arguments name before it.
struct Candidate {
  const CheckedScenario* scenario;
  std::vector<GoalRequest> goals;  // the last one is the goal itself
};

std::vector<GoalRequest> goals_of(const CheckedScenario& scenario, const MissionModel& model) {
  std::vector<GoalRequest> out;
  for (const auto& stimulus : scenario.run.scenario.stimuli) {
    const auto* goal = std::get_if<GoalStimulus>(&stimulus.what);
    if (goal == nullptr || addressee(model.role, goal->robot) != exec::mission::Addressee::this_one) continue;
    GoalRequest request = request_of(*goal);
    request.opens = request.closes = temporal::Time{};
    out.push_back(std::move(request));
  }
  return out;
}

// Puts the goals that `goal` names before it, and it at the end.
void add_with_named(const GoalRequest& goal, const std::vector<GoalRequest>& all, const MissionModel& model,
                    std::vector<GoalRequest>& out) {
  if (std::ranges::find(out, goal) != out.end()) return;
  const auto kind = model.goal_kinds.find(goal.kind);
  if (kind == model.goal_kinds.end()) return;
  for (const auto& [name, type] : kind->second.arguments) {
    const auto value = goal.arguments.find(name);
    if (type != exec::mission::ArgumentKind::goal || value == goal.arguments.end()) continue;
    for (const GoalRequest& other : all)
      if (other.key.id == value->second && !(other == goal)) add_with_named(other, all, model, out);
  }
  out.push_back(goal);
}

// The example of a kind that no scenario asks for, if it names no other goal.
std::optional<GoalRequest> example_of(const mission::Entry& entry, const MissionModel& model,
                                      const GoalKind& kind) {
  GoalRequest out;
  out.key = {"ground", "check"};
  out.robot = model.role.robot;
  out.kind = kind.name;
  if (const auto example = entry.find("example"))
    for (const auto& [name, value] : example->fields()) out.arguments[name] = value.text();
  for (const auto& [name, type] : kind.arguments)
    if (type == exec::mission::ArgumentKind::goal || !out.arguments.contains(name)) return std::nullopt;
  return out;
}

std::vector<Candidate> candidates(const CheckedMission& mission, const MissionModel& model,
                                  const GoalKind& kind, const mission::Entry& entry) {
  std::vector<Candidate> out;
  const CheckedScenario* any = nullptr;
  for (const CheckedScenario& scenario : mission.scenarios) {
    if (any == nullptr) any = &scenario;
    const auto all = goals_of(scenario, model);
    for (const GoalRequest& goal : all) {
      if (goal.kind != kind.name) continue;
      Candidate& candidate = out.emplace_back(Candidate{&scenario, {}});
      add_with_named(goal, all, model, candidate.goals);
    }
  }
  if (!out.empty() || any == nullptr) return out;
  if (auto example = example_of(entry, model, kind)) out.push_back({any, {std::move(*example)}});
  return out;
}

exec::beliefs::Beliefs first_beliefs(const MissionModel& model, const CheckedScenario& scenario) {
  exec::beliefs::Beliefs beliefs(model);
  sim::world::World world(scenario.run.world, 1);
  for (const auto& output : world.advance(temporal::Time{}))
    if (const auto* observed = std::get_if<sim::world::Observed>(&output))
      beliefs.observe(observed->timeline, observed->value);
  for (const exec::mission::Component* component : beliefs.unobserved()) {
    const auto rest = std::ranges::find(component->states, false, &exec::mission::StateModel::active);
    if (rest != component->states.end()) beliefs.observe(component->timeline, temporal::state(rest->name));
  }
  return beliefs;
}

Request request_for(const MissionModel& model, const exec::problem::Problem& problem) {
  Request out;
  out.engine = model.planner.engine;
  out.robot = model.role.robot;
  out.origin = model.planner.allowance;
  out.model = model.model_text;
  out.problem_text = problem.text;
  out.state = problem.state;
  for (const auto& goal : problem.goals) {
    planner::engine::Goal& wanted = out.goals.emplace_back();
    wanted.issuer = goal.key.issuer;
    wanted.id = goal.key.id;
    wanted.achieved = goal.achieved;
  }
  for (const auto& object : problem.objects)
    out.objects.push_back({object.name, object.type, object.properties});
  out.work = model.planner.work != 0 ? model.planner.work : kWork;
  out.memory_bytes = static_cast<std::size_t>(model.planner.memory_mb) << 20U;
  return out;
}

Answer planned(const MissionModel& model, const Candidate& candidate, AskedOwners& owners) {
  auto beliefs = first_beliefs(model, *candidate.scenario);
  GoalSet goals(model);
  for (const GoalRequest& goal : candidate.goals) {
    const auto taken = goals.submit(goal, temporal::Time{});
    if (taken.record->state == GoalState::rejected)
      return planner::engine::without_plan(Verdict::invalid_input, taken.record->reason);
    const auto values = template_values(goal);
    for (const auto& [timeline, facts] : model.goal_kinds.at(goal.kind).unobserved) {
      std::vector<std::string> filled;
      for (const std::string& fact : facts) filled.push_back(exec::mission::fill_names(fact, values));
      beliefs.assume(exec::mission::fill_names(timeline, values), std::move(filled));
    }
  }
  const auto problem =
      exec::problem::write_problem(model, beliefs, goals, "check", temporal::Time{}, model.planner.allowance);
  if (!problem.left_out.empty())
    return planner::engine::without_plan(
        Verdict::invalid_input,
        "the problem cannot hold " + problem.left_out.front().part + ": " + problem.left_out.front().why);
  if (!problem.unusable_goals.empty())
    return planner::engine::without_plan(Verdict::invalid_input, problem.unusable_goals.front().why);
  const Request request = request_for(model, problem);
  owners.begin(request);
  const auto begun = services::clock::wall_now();
  planner::engine::Limits limits;
  limits.out_of_time = [begun] { return services::clock::wall_now() - begun > kPlanningTime; };
  return answer_checked(planner::engines(), request, limits, owners);
}

std::string arguments_text(const GoalRequest& goal) {
  std::string out;
  for (const auto& [name, value] : goal.arguments) out += " " + name + "=" + value;
  return out.empty() ? "" : " with" + out;
}

// The words of an owner of functions end with who says so (engine/owners_words); others are the planner's own.
bool is_said_by_owner(const std::string& reason) { return reason.find("(says ") != std::string::npos; }

// Why there is no plan, without a word of how planners work.
std::string why_not(const MissionModel& model, const GoalRequest& goal, const Answer& answer) {
  switch (answer.verdict) {
    case Verdict::unsolvable:
      break;
    case Verdict::timeout:
      if (answer.lacks_values) break;
      return "none was found within planner.budget (work: " + std::to_string(model.planner.work) + ")";
    case Verdict::out_of_memory:
      return "none was found within planner.budget (memory_mb: " + std::to_string(model.planner.memory_mb) +
             ")";
    default:
      return std::string(to_string(answer.verdict)) + ": " + answer.reason;
  }
  for (const auto& blocking : answer.blocking) {
    const bool itself = blocking.issuer == goal.key.issuer && blocking.id == goal.key.id;
    const std::string whose = itself ? "" : "goal '" + blocking.id + "', which it needs, is out of reach: ";
    if (is_said_by_owner(blocking.reason) || !blocking.proved) return whose + blocking.reason;
    if (!blocking.timeline.empty())
      return whose + "from where the scenario starts no action brings about " + blocking.timeline;
  }
  return "from where the scenario starts no sequence of actions leads to it";
}

// What stands in the way, at the kind's entry. A budget that is spent proves nothing.
mission::Finding obstacle(const mission::Entry& kind, const std::string& name, const MissionModel& model,
                          const Candidate& candidate, const Answer& answer) {
  const bool spent = answer.verdict == Verdict::timeout || answer.verdict == Verdict::out_of_memory;
  mission::Finding out =
      mission::finding_of(kind.place() + ": ", spent ? mission::Severity::warning : mission::Severity::error);
  out.what = "no plan achieves a goal of kind '" + name + "' (goal '" + candidate.goals.back().key.id +
             "' of scenario '" + candidate.scenario->name + "')" + arguments_text(candidate.goals.back()) +
             ": " + why_not(model, candidate.goals.back(), answer);
  out.remedy = spent ? "raise planner.budget, or make the goal easier"
                     : "check its facts, the domain's actions, the place, and the scenario's start; "
                       "roci-check --why has "
                       "the planner's own words";
  return out;
}

std::string why_not_tried(const CheckedMission& mission, const MissionModel& model) {
  if (mission.world.empty()) return "the world is not sim_svc's";
  if (!model.domain) return "engine '" + model.planner.engine + "' reads no PDDL";
  if (!planner::engines().contains(model.planner.engine))
    return "engine '" + model.planner.engine + "' is not linked here";
  for (const exec::mission::Component& component : model.components) {
    const auto rest = std::ranges::find(component.states, false, &exec::mission::StateModel::active);
    if (component.owner == mission.world.service || rest == component.states.end()) continue;
    if (std::ranges::any_of(rest->facts,
                            [](const std::string& fact) { return fact.find('?') != std::string::npos; }))
      return "where '" + component.name + "' begins, '" + component.owner + "' alone says";
  }
  return "";
}

// An engine that no planner of the mission has: where programs of its owner fly,
// only a name that is nearly one of ours.
void check_engine(const CheckedMission& mission, const CheckedExecutive& executive) {
  const std::string& engine = executive.model.planner.engine;
  std::vector<std::string> known;
  for (const auto& [name, entry] : planner::engines()) known.push_back(name);
  if (contains(known, engine) || (!mission.closed && words::nearest_word(engine, known).empty())) return;
  const auto planner = executive.file.find("planner");
  const auto said = planner ? planner->find("engine") : std::nullopt;
  said.value_or(executive.file)
      .complain("no planner has an engine '" + engine + "'; " + instead_of(engine, known));
}

// Modules that only a program of the mission's owner can offer cannot be asked for here.
std::string why_no_functions(const CheckedMission& mission, const MissionModel& model, const Answer& answer) {
  const bool own =
      answer.verdict == Verdict::function_unavailable && !mission.closed && !model.domain->modules.empty();
  return own ? "a program of the mission's own answers: " + answer.reason : "";
}

// A function of a module that is asked for, or a module alone, with the places of both names.
struct AskedName {
  std::string module, function;
  mission::Finding module_at, function_at;
};

std::vector<AskedName> asked_by_domain(const pddl::Domain& domain) {
  const auto at = [&](const pddl::SourceLocation& where) {
    return mission::Finding{domain.file, where.line, where.column, mission::Severity::error, "", ""};
  };
  std::vector<AskedName> out;
  for (const pddl::Module& module : domain.modules) {
    out.push_back({module.name, "", at(module.where), at(module.where)});
    for (const pddl::Signature& function : module.functions)
      out.push_back({module.name, function.name, at(module.where), at(function.where)});
  }
  return out;
}

std::vector<AskedName> asked_by_model(const CheckedExecutive& executive) {
  const auto engine = planner::engines().find(executive.model.planner.engine);
  const auto model = executive.file.find("model");
  if (engine == planner::engines().end() || !engine->second.asked_functions || !model) return {};
  const std::filesystem::path file = model->resolve(model->text());
  std::vector<AskedName> out;
  for (const auto& one : engine->second.asked_functions(executive.model.model_text, file.filename())) {
    mission::Finding at = mission::finding_of(one.place + ": ");
    at.file = (file.parent_path() / at.file).string();
    out.push_back({one.module, one.function, at, at});
  }
  return out;
}

}  // namespace

DryPlans dry_plan(const CheckedMission& mission, const CheckedExecutive& executive, AskedOwners& owners,
                  mission::Findings& findings) {
  DryPlans out;
  const MissionModel& model = executive.model;
  const auto kinds = executive.file.find("goal_kinds");
  check_engine(mission, executive);
  const std::string why = why_not_tried(mission, model);
  for (const auto& [name, kind] : model.goal_kinds) {
    if (!why.empty()) {
      out.not_tried.push_back({name, why});
      continue;
    }
    const auto tries = candidates(mission, model, kind, kinds->at(name));
    if (tries.empty())
      out.not_tried.push_back({name, "no scenario asks for one, and it has no example of its own"});
    std::optional<Answer> first;
    for (std::size_t i = 0; i < std::min(kTries, tries.size()); ++i) {
      Answer answer = planned(model, tries[i], owners);
      if (answer.verdict == Verdict::solved) {
        out.planned.push_back({name, tries[i].scenario->name, tries[i].goals.back().key.id,
                               answer.plan ? answer.plan->activities.size() : 0});
        first.reset();
        break;
      }
      if (i == 0) first = std::move(answer);
    }
    if (!first) continue;
    if (std::string unasked = why_no_functions(mission, model, *first); !unasked.empty()) {
      out.not_tried.push_back({name, std::move(unasked)});
    } else {
      findings.add(obstacle(kinds->at(name), name, model, tries.front(), *first));
      out.unachieved.push_back({name, tries.front().scenario->name, tries.front().goals.back().key.id,
                                to_string(first->verdict), first->reason});
    }
  }
  return out;
}

void check_engine_model(CheckedExecutive& executive, mission::Findings& findings) {
  const auto engine = planner::engines().find(executive.model.planner.engine);
  const auto model = executive.file.find("model");
  if (engine == planner::engines().end() || !engine->second.check_model || !model) return;
  if (executive.model.model_text.empty()) return;  // it could not be read, which is known by now
  const std::filesystem::path file = model->resolve(model->text());
  mission::Findings found;
  auto timelines = engine->second.check_model(executive.model.model_text, file.filename(), found);
  for (mission::Finding one : found.all()) {
    one.file = (file.parent_path() / one.file).string();
    findings.add(std::move(one));
  }
  if (found.errors() == 0) executive.planned_timelines = std::move(timelines);
}

void check_functions(const CheckedMission& mission, const CheckedExecutive& executive, AskedOwners& owners,
                     mission::Findings& findings) {
  const std::vector<AskedName> asked =
      executive.model.domain ? asked_by_domain(*executive.model.domain) : asked_by_model(executive);
  std::vector<std::string> modules;
  for (const AskedName& one : asked) modules.push_back(one.module);
  const auto& offered = owners.offered(modules);
  std::vector<std::string> known;
  for (const auto& [name, functions] : offered) known.push_back(name);
  const auto add = [&](mission::Finding finding, const std::string& what, const std::string& word,
                       const std::vector<std::string>& words) {
    if (!mission.closed && words::nearest_word(word, words).empty()) return;
    finding.what = what;
    finding.remedy = instead_of(word, words);
    findings.add(std::move(finding));
  };
  for (const AskedName& one : asked) {
    const auto functions = offered.find(one.module);
    if (functions == offered.end()) {
      add(one.module_at, "no service of the mission offers module '" + one.module + "'", one.module, known);
    } else if (!one.function.empty() && !contains(functions->second, one.function)) {
      add(one.function_at, "module '" + one.module + "' offers no function '" + one.function + "'",
          one.function, functions->second);
    }
  }
}

}  // namespace roci::rehearsal::check
