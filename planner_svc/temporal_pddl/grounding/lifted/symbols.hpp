// Symbols number the names of the model.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/types.hpp"
#include "planner_svc/temporal_pddl/task/ids.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

/// Describes a fluent or an external function.
struct FunctionSymbol {
  std::string name;
  std::string module;                                   ///< empty: a fluent of the domain
  std::vector<std::vector<task::ObjectId>> parameters;  ///< the objects that each may be
  pddl::SourceLocation declared;                        ///< is a place in the domain's file
};

/// Looks up the names of a checked model, from which it is built: every name that is looked up is there.
class Symbols {
 public:
  Symbols(const pddl::Domain& domain, const pddl::Problem& problem);

  /// Adds a predicate that the model does not know, under a name for reports.
  task::PredicateId add_predicate(std::string name) { return predicate_names_.push_back(std::move(name)); }

  task::ObjectId object(const std::string& name) const {
    return task::ObjectId(static_cast<std::size_t>(objects_.find(name)));
  }
  task::PredicateId predicate(const std::string& name) const { return predicates_.at(name); }
  task::FunctionId function(const std::string& name) const { return function_ids_.at(name); }
  std::vector<task::ObjectId> of_types(const std::vector<std::string>& types) const;

  /// Returns the fluent that begins at 0 without being told to, if the domain has it.
  std::optional<task::FunctionId> total_cost() const { return total_cost_; }

  std::size_t objects() const { return objects_.size(); }
  std::size_t predicates() const { return predicate_names_.size(); }
  std::size_t functions() const { return functions_.size(); }
  const std::string& name(task::ObjectId id) const { return objects_[id.index()].name; }
  const std::string& name(task::PredicateId id) const { return predicate_names_[id]; }
  const std::string& domain_file() const { return domain_file_; }
  const FunctionSymbol& operator[](task::FunctionId id) const { return functions_[id]; }

 private:
  std::string domain_file_;
  pddl::ObjectTable objects_;
  std::map<std::string, task::PredicateId> predicates_;
  task::IdVector<task::PredicateId, std::string> predicate_names_;
  std::map<std::string, task::FunctionId> function_ids_;
  task::IdVector<task::FunctionId, FunctionSymbol> functions_;
  std::optional<task::FunctionId> total_cost_;
};

}  // namespace roci::planner::temporal_pddl::grounding::lifted
