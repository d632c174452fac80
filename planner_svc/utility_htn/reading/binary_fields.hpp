// This file lists the fields of a network in the order of its binary form, once for writing and reading. An
// archive has Of<T> (const T& or T&) and takes numbers, texts, flags, enumerators, times, lists with their
// greatest length, and what may be missing.
#pragma once

#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::reading {

template <typename A>
void fields(A& a, typename A::template Of<model::Amount> amount) {
  a.real(amount.constant);
  a.optional(amount.parameter);
  if (amount.parameter) a.real(amount.factor);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Parameter> parameter) {
  a.text(parameter.name);
  a.real(parameter.prior);
  a.real(parameter.lowest);
  a.real(parameter.highest);
  a.text(parameter.source);
}

template <typename A>
void fields(A& a, typename A::template Of<temporal::timelines::Definition> timeline) {
  a.text(timeline.name);
  a.enumeration(timeline.kind, 5);
  a.list(timeline.states, model::kMostStates);
  a.real(timeline.initial);
  a.real(timeline.lowest);
  a.real(timeline.highest);
  a.flag(timeline.reported);
}

template <typename A>
void fields(A& a, typename A::template Of<temporal::timelines::Constraint> constraint) {
  a.number(constraint.timeline);
  a.enumeration(constraint.phase, 3);
  a.real(constraint.lowest);
  a.real(constraint.highest);
  a.number(constraint.states);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Impact> impact) {
  a.number(impact.timeline);
  a.enumeration(impact.kind, 3);
  a.enumeration(impact.moment, 3);
  fields(a, impact.amount);
}

template <typename A>
void fields(A& a, typename A::template Of<temporal::Property> property) {
  a.text(property.name);
  a.text(property.value);
}

template <typename A>
void fields(A& a, typename A::template Of<temporal::PlanCommand> command) {
  a.text(command.owner);
  a.text(command.robot);
  a.text(command.subsystem);
  a.text(command.command_name);
  a.list(command.arguments, model::kMostInList);
  a.time(command.answer_within);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Product> product) {
  a.text(product.name);
  a.enumeration(product.tier, 4);
  fields(a, product.bytes);
  a.scores(product.utility);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Control> control) {
  a.time(control.wait_timeout);
  a.time(control.answer_within);
  a.number(control.retries);
  a.flag(control.may_skip);
  a.list(control.skip_if, model::kMostInList);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Contingency> contingency) {
  a.list(contingency.requests, model::kMostInList);
  a.list(contingency.withdraws, model::kMostInList);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Subtask> subtask) {
  a.number(subtask.task);
  a.time(subtask.shortest_gap);
  a.time(subtask.longest_gap);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Decomposition> decomposition) {
  a.text(decomposition.name);
  a.list(decomposition.when, model::kMostInList);
  a.list(decomposition.subtasks, model::kMostInList);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Learns> learns) {
  a.enumeration(learns.measure, 4);
  a.number(learns.parameter);
  if (learns.measure == model::Measure::value) a.text(learns.result);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Task> task) {
  a.text(task.id);
  a.text(task.name);
  a.whole(task.priority);
  a.flag(task.is_template);
  a.number(task.batch);
  a.flag(task.fixed);
  a.list(task.commands, model::kMostInList);
  a.optional(task.response);
  a.optional(task.contingency);
  fields(a, task.duration);
  a.time(task.preferred_start);
  a.time(task.opens);
  a.time(task.closes);
  a.list(task.impacts, model::kMostInList);
  a.list(task.constraints, model::kMostInList);
  fields(a, task.control);
  a.list(task.utility, model::kMostRanks);
  a.list(task.products, model::kMostInList);
  a.flag(task.downlinks);
  a.list(task.learns, model::kMostInList);
  a.list(task.decompositions, model::kMostInList);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Target> target) {
  a.number(target.task);
  a.number(target.signature);
  fields(a, target.visual);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Site> site) {
  a.text(site.name);
  fields(a, site.value);
  a.list(site.targets, model::kMostInList);
}

template <typename A>
void fields(A& a, typename A::template Of<model::Network> network) {
  a.text(network.name);
  a.number(network.version);
  a.list(network.ranks, model::kMostRanks);
  a.list(network.parameters, model::kMostParameters);
  a.list(network.timelines, model::kMostTimelines);
  a.number(network.budget);
  a.list(network.tasks, model::kMostTasks);
  a.list(network.batches, model::kMostBatches);
  a.number(network.subway.most_samples);
  a.number(network.subway.rank);
  a.list(network.subway.sites, model::kMostInList);
  a.time(network.cycle.process_interval);
  a.time(network.cycle.worst_cycle);
  a.time(network.cycle.commit_window);
  a.time(network.cycle.scheduling_window);
  a.time(network.cycle.plan_end);
  a.number(network.exploration_bound);
}

}  // namespace roci::planner::utility_htn::reading
