// The fields of what an engine that plans all the time hears and puts out, each type once, for writing and reading.
// Whoever changes them raises kStepRecordFormat.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "planner_svc/engine/step_record.hpp"

template <>
struct nlohmann::adl_serializer<roci::temporal::Duration> {
  static void to_json(json& out, roci::temporal::Duration value) { out = value.count(); }
  static void from_json(const json& in, roci::temporal::Duration& value) {
    value = roci::temporal::Duration{in.get<std::int64_t>()};
  }
};

template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
  static void to_json(json& out, const std::optional<T>& value) {
    out = nullptr;
    if (value) out = *value;
  }
  static void from_json(const json& in, std::optional<T>& value) {
    value.reset();
    if (!in.is_null()) value = in.get<T>();
  }
};

// Is null, a boolean, a number, or of a state the list of its name and its arguments.
template <>
struct nlohmann::adl_serializer<roci::temporal::Value> {
  static void to_json(json& out, const roci::temporal::Value& value) {
    out = nullptr;
    if (const auto* truth = std::get_if<bool>(&value)) out = *truth;
    if (const auto* number = std::get_if<double>(&value)) out = *number;
    if (const auto* state = std::get_if<roci::temporal::State>(&value)) {
      out = state->arguments;
      out.insert(out.begin(), state->name);
    }
  }
  static void from_json(const json& in, roci::temporal::Value& value) {
    value = std::monostate{};
    if (in.is_boolean()) value = in.get<bool>();
    if (in.is_number()) value = in.get<double>();
    if (!in.is_array()) return;
    auto words = in.get<std::vector<std::string>>();
    roci::temporal::State state{words.at(0), {}};
    state.arguments.assign(words.begin() + 1, words.end());
    value = std::move(state);
  }
};

template <>
struct nlohmann::adl_serializer<roci::temporal::RankVector> {
  static void to_json(json& out, const roci::temporal::RankVector& value) {
    out = std::vector<double>(value.scores().begin(), value.scores().end());
  }
  static void from_json(const json& in, roci::temporal::RankVector& value) {
    value = roci::temporal::RankVector(in.get<std::vector<double>>());
  }
};

// What nlohmann's NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE does in the type's own namespace, for types of other folders.
#define ROCI_RECORDED(Type, ...)                                                 \
  template <>                                                                    \
  struct nlohmann::adl_serializer<Type> {                                        \
    static void to_json(json& nlohmann_json_j, const Type& nlohmann_json_t) {    \
      NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__))   \
    }                                                                            \
    static void from_json(const json& nlohmann_json_j, Type& nlohmann_json_t) {  \
      NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM, __VA_ARGS__)) \
    }                                                                            \
  };

ROCI_RECORDED(roci::temporal::Property, name, value)
ROCI_RECORDED(roci::temporal::ConditionNode, op, child_count, timeline, operand)
ROCI_RECORDED(roci::temporal::Condition, nodes)
ROCI_RECORDED(roci::temporal::Impact, timeline, kind, moment, amount)
ROCI_RECORDED(roci::temporal::TemporalConstraint, from_point, to_point, kind, lower, upper)
ROCI_RECORDED(roci::temporal::PlanCommand, owner, robot, subsystem, command_name, arguments, answer_within)
ROCI_RECORDED(roci::temporal::PlanActivity, id, name, level, parent, owner, robot, subsystem, command_name,
              arguments, answer_within, then, start_point, end_point, duration_lower, duration_upper,
              preferred_start, pre, maintenance, post, impacts, wait_timeout, retries, may_skip, skip_if,
              lateness, commit, failure, contingency, priority, goals_served, utility)
ROCI_RECORDED(roci::temporal::Token, timeline, held, start_point, end_point)
ROCI_RECORDED(roci::temporal::DecisionChoice, name, activities, rule)
ROCI_RECORDED(roci::temporal::ArgumentBinding, activity, argument)
ROCI_RECORDED(roci::temporal::DecisionPoint, id, resolver, choices, decide_before, resolver_kind, bindings,
              admissible)
ROCI_RECORDED(roci::temporal::FunctionValueUse, function, arguments, number, owner, model_version, computed,
              accuracy)
ROCI_RECORDED(roci::temporal::FlexiblePlan, id, version, engine, origin, point_count, activities, tokens,
              decisions, constraints, function_values)
ROCI_RECORDED(roci::temporal::PlanDelta, from_version, added, removed_activities, removed_decisions,
              removed_tokens, removed_constraints)
ROCI_RECORDED(roci::temporal::ActivityProgress, state, started, ended)

ROCI_RECORDED(roci::planner::engine::Goal, issuer, id, achieved, kind, arguments, importance, utility,
              priority, preferred, opens, closes)
ROCI_RECORDED(roci::planner::engine::EndedGoal, issuer, id, state)
ROCI_RECORDED(roci::planner::engine::Observation, timeline, value, sampled)
ROCI_RECORDED(roci::planner::engine::StepStatus, plan_version, activity, progress, cause, attempt)
ROCI_RECORDED(roci::planner::engine::CommandResult, activity, attempt, energy_j, values)
ROCI_RECORDED(roci::planner::engine::DataProduct, id, kind, source, tier, bytes, created, utility, fate, told)
ROCI_RECORDED(roci::planner::engine::ModelChange, issuer, id, model, parameter, value)
ROCI_RECORDED(roci::planner::engine::Receipt, version, refused, reason, conflict, open)
ROCI_RECORDED(roci::planner::engine::StepInputs, now, goals, ended_goals, observations, steps, results,
              products, model_changes, receipt, executed, last_version)
ROCI_RECORDED(roci::planner::engine::RecordedEngine, engine, robot, resolvers, model)
ROCI_RECORDED(roci::planner::engine::StepOutcome, account, version, delta, fault)

#undef ROCI_RECORDED
