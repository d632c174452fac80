// The model is the problem as the validator looks things up in it; nothing is grounded.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/function_table.hpp"
#include "core/pddl/stratify.hpp"
#include "core/pddl/types.hpp"
#include "planner_svc/temporal_pddl/validate/bindings.hpp"
#include "planner_svc/temporal_pddl/validate/state.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Holds references: domain, problem and table must outlive it. It takes models in which check() finds
/// nothing wrong.
class Model {
 public:
  Model(const pddl::Domain& domain, const pddl::Problem& problem, const pddl::FunctionTable& functions);

  const pddl::Domain& domain() const { return domain_; }
  const pddl::Problem& problem() const { return problem_; }
  const pddl::ObjectTable& objects() const { return objects_; }
  const pddl::FunctionTable& functions() const { return functions_; }

  bool is_external(const std::string& function) const { return externals_.contains(function); }
  /// Returns whether no effect and no timed fact ever changes the predicate or fluent; of a derived predicate,
  /// whether it hangs on such ones alone.
  bool is_static(const std::string& symbol) const { return !changing_.contains(symbol); }
  /// Returns the rules of a derived predicate; there are none for others.
  const std::vector<const pddl::DerivedPredicate*>& rules(const std::string& predicate) const;
  /// Holds what was found of the instances of derived predicates that are static: it is so in every state.
  std::map<std::string, bool>& constants() const { return constants_; }
  /// Returns whether the truth of a derived predicate may rest on itself.
  bool is_recursive(const std::string& derived) const { return recursive_.contains(derived); }
  int layer(const std::string& derived) const { return strata_.layer.at(derived); }

  State initial_state() const;

  /// Calls visit() for each choice of objects for the variables, bound in `bindings`, until it returns false.
  /// Returns false if it was stopped.
  bool for_each_choice(const std::vector<pddl::TypedName>& variables, Bindings& bindings,
                       const std::function<bool()>& visit) const;

 private:
  const pddl::Domain& domain_;
  const pddl::Problem& problem_;
  const pddl::FunctionTable& functions_;
  pddl::ObjectTable objects_;
  pddl::Strata strata_;
  std::map<std::string, std::vector<const pddl::DerivedPredicate*>> rules_;
  std::set<std::string> externals_;
  std::set<std::string> changing_;  // predicates and fluents
  std::set<std::string> recursive_;  // derived predicates
  mutable std::map<std::string, bool> constants_;
};

}  // namespace roci::planner::temporal_pddl::validate
