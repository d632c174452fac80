// This file is internal to core/pddl: it has the checks that domain and problem share.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/types.hpp"

namespace roci::pddl {

/// Collects what was found in one file.
class Findings {
 public:
  explicit Findings(std::string file) : file_(std::move(file)) {}

  void add(SourceLocation where, std::string message, std::string remedy) {
    diagnostics_.push_back({file_, where, std::move(message), std::move(remedy)});
  }
  std::vector<Diagnostic> take() { return std::move(diagnostics_); }

 private:
  std::string file_;
  std::vector<Diagnostic> diagnostics_;
};

/// Tells what an expression may mention, which depends on where it stands.
struct ExpressionContext {
  bool duration = false;         ///< ?duration
  bool total_time = false;       ///< total-time
  bool continuous_time = false;  ///< #t
};

/// Knows everything declared, by name. It points into the domain, which must outlive it.
class Symbols {
 public:
  explicit Symbols(const Domain& domain);

  void add_objects(const std::vector<TypedName>& objects);

  const Signature* find_predicate(const std::string& name) const;
  const Signature* find_fluent(const std::string& name) const;
  const Signature* find_external(const std::string& name) const;
  /// Returns all types that an object was declared with, in one or several declarations, or null.
  const std::vector<std::string>* find_object_types(const std::string& name) const;
  bool is_derived(const std::string& name) const { return derived_.contains(name); }
  const TypeTree& types() const { return types_; }

 private:
  std::map<std::string, const Signature*> predicates_;
  std::map<std::string, const Signature*> fluents_;
  std::map<std::string, const Signature*> externals_;
  std::map<std::string, std::vector<std::string>> objects_;
  std::set<std::string> derived_;
  TypeTree types_;
};

/// Walks conditions, effects and expressions with the variables bound so far. `Symbols` and `Findings` must
/// outlive it.
class FormulaChecker {
 public:
  FormulaChecker(const Symbols& symbols, Findings& findings) : symbols_(symbols), findings_(findings) {}

  /// Binds variables for the checks that follow, until unbind(variables.size()).
  void bind(const std::vector<TypedName>& variables);
  void unbind(std::size_t count) { bound_.resize(bound_.size() - count); }

  void check_fact(const Atom& atom);        ///< predicate, arity, arguments
  void check_basic_fact(const Atom& atom);  ///< … and not derived: what effects and :init may set
  void check_fluent(const Atom& atom);      ///< a fluent that may be assigned
  void check_expression(const Expression& expression, ExpressionContext context);
  void check_condition(const Condition& condition);
  void check_timed(const TimedCondition& condition);
  void check_effects(const std::vector<Effect>& effects, ExpressionContext context);

 private:
  void check_arguments(const Atom& atom, const Signature& signature, std::string_view what);
  void check_argument(const Term& term, const TypedName& parameter, const std::string& owner);
  const TypedName* find_variable(const std::string& name) const;

  const Symbols& symbols_;
  Findings& findings_;
  std::vector<const TypedName*> bound_;
};

/// Reports every type of the names that nobody declared.
void check_types(const std::vector<TypedName>& names, const Symbols& symbols, Findings& findings);

/// Checks the types of the variables, and that none stands twice.
void check_variables(const std::vector<TypedName>& variables, const Symbols& symbols, Findings& findings);

}  // namespace roci::pddl
