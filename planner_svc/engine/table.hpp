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

/// Says where a model asks a service for numbers.
struct AskedFunction {
  std::string module;
  std::string function;
  std::string place;  ///< "file:line:column"
};

struct TableEntry {
  std::variant<MakeAnswering, MakeStepped> make;
  std::function<std::unique_ptr<Checker>()> make_checker;
  /// Serves an engine whose plans leave decisions to itself; empty: they leave none. It may throw as MakeStepped does.
  std::function<std::unique_ptr<DecisionResolver>(const Setup&)> make_resolver{};
  /// The ways to search that a mission may name for it (Request::resolvers, Setup::resolvers); none: it has one alone.
  std::vector<std::string> resolvers{};
  /// Throws std::invalid_argument, with the remedy, for some of these that do not go together; empty: all do.
  std::function<void(const std::vector<std::string>&)> check_resolvers{};
  /// Of an engine with models of its own: the functions that one asks for, in its order. The model is the text that a
  /// mission has of its file, the name that of the file where the text names none. One that cannot be read asks for
  /// none.
  std::function<std::vector<AskedFunction>(const std::string& model, const std::string& name)>
      asked_functions{};
};

/// Goes by name, as mission.yaml and PlanRequest give it.
using Table = std::map<std::string, TableEntry>;

/// "a, b, c": the engines that answer calls; "none".
std::string names_of_answering(const Table& table);

/// Null if there is no engine of that name that plans all the time.
const MakeStepped* stepped_named(const Table& table, const std::string& name);

}  // namespace roci::planner::engine
