// The table has the engines of a planner by name: how each is made, and its checker.
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

namespace roci::mission {
class Findings;
}

namespace roci::planner::engine {

using MakeAnswering = std::function<std::unique_ptr<AnsweringEngine>()>;
/// Makes a stepped engine. Throws std::exception with file, line and remedy for a model that the engine does
/// not take.
using MakeStepped = std::function<std::unique_ptr<SteppedEngine>(const Setup&)>;

/// Says where a model asks a service for numbers.
struct AskedFunction {
  std::string module;
  std::string function;
  std::string place;  ///< "file:line:column"
};

/// Says how one engine is made, how its plans are checked, and what a mission may choose of it.
struct TableEntry {
  std::variant<MakeAnswering, MakeStepped> make;
  std::function<std::unique_ptr<Checker>()> make_checker;
  /// Serves an engine whose plans leave decisions to itself; empty: they leave none. It may throw as MakeStepped does.
  std::function<std::unique_ptr<DecisionResolver>(const Setup&)> make_resolver{};
  /// Lists the ways to search that a mission may name for it (Request::resolvers, Setup::resolvers); none: it has one
  /// alone.
  std::vector<std::string> resolvers{};
  /// Throws std::invalid_argument, with the remedy, for resolvers that do not go together; empty: all do.
  std::function<void(const std::vector<std::string>&)> check_resolvers{};
  /// Returns, for an engine with models of its own, the functions that a model asks for, in its order. The model is
  /// the text that a mission has of its file, `name` the file's name where the text names none. A model that cannot
  /// be read asks for none.
  std::function<std::vector<AskedFunction>(const std::string& model, const std::string& name)>
      asked_functions{};
  /// Notes, for an engine whose models come with each request, what is wrong with a model, each fault with its place.
  /// Returns the timelines that its states are observed by, of which its plans tell; one that ends in '.' stands for
  /// all that begin so. `model` and `name` are as above.
  std::function<std::vector<std::string>(const std::string& model, const std::string& name,
                                         mission::Findings& findings)>
      check_model{};
};

/// Maps names, as mission.yaml and PlanRequest give them, to engines.
using Table = std::map<std::string, TableEntry>;

/// Returns the names of the engines that answer calls, as "a, b, c", or "none".
std::string names_of_answering(const Table& table);

/// Returns how the engine of that name is made, or null if there is none that plans all the time.
const MakeStepped* stepped_named(const Table& table, const std::string& name);

}  // namespace roci::planner::engine
