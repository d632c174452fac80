// The engines of a planner by name: how each is made, and its checker.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "planner_svc/engine/answering_engine.hpp"
#include "planner_svc/engine/checker.hpp"
#include "planner_svc/engine/decision_resolver.hpp"
#include "planner_svc/engine/stepped_engine.hpp"

namespace roci::planner::engine {

using MakeAnswering = std::function<std::unique_ptr<AnsweringEngine>()>;
/// Throws std::exception with file, line and remedy for a model that the engine does not take.
using MakeStepped = std::function<std::unique_ptr<SteppedEngine>(const Setup&)>;

struct TableEntry {
  std::variant<MakeAnswering, MakeStepped> make;
  std::function<std::unique_ptr<Checker>()> make_checker;
  /// Serves an engine whose plans leave decisions to itself; empty: they leave none. It may throw as MakeStepped does.
  std::function<std::unique_ptr<DecisionResolver>(const Setup&)> make_resolver{};
  /// The ways to search that a mission may name for it (Request::resolvers); none: it has one alone.
  std::vector<std::string> resolvers{};
};

/// Goes by name, as mission.yaml and PlanRequest give it.
using Table = std::map<std::string, TableEntry>;

/// "a, b, c": the engines that answer calls; "none".
std::string names_of_answering(const Table& table);

/// Null if there is no engine of that name that plans all the time.
const MakeStepped* stepped_named(const Table& table, const std::string& name);

}  // namespace roci::planner::engine
