// This file is internal to core/pddl: it has the checks that domain and problem share.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/parse_parts.hpp"
#include "core/pddl/types.hpp"

namespace roci::pddl {

/// Collects what was found in one file.
class Findings {
 public:
  explicit Findings(std::string file) : file_(std::move(file)) {}

  void add(SourceLocation where, std::string message, std::string remedy) {
    diagnostics_.push_back({file_, where, std::move(message), std::move(remedy)});
  }
  std::size_t size() const { return diagnostics_.size(); }
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

/// Knows everything declared, by name. It points into the domain and the objects that are added, which must outlive it.
class Symbols {
 public:
  /// Bounds the types of one object, all its declarations together.
  static constexpr std::size_t kMostTypes = 200;

  /// `unread` says where something may be declared that could not be read.
  explicit Symbols(const Domain& domain, Unread unread = {});

  void add_objects(const std::vector<TypedName>& objects);
  const Unread& unread() const { return unread_; }

  /// These return what to do about an unknown name: the nearest known one, or `otherwise`.
  std::string remedy_for_type(std::string_view name, std::string_view otherwise) const;
  std::string remedy_for_predicate(std::string_view name, std::string_view otherwise) const;
  std::string remedy_for_function(std::string_view name, std::string_view otherwise) const;
  std::string remedy_for_object(std::string_view name, std::string_view otherwise) const;

  const Signature* find_predicate(std::string_view name) const;
  const Signature* find_fluent(std::string_view name) const;
  const Signature* find_external(std::string_view name) const;
  /// Returns all types that an object was declared with, in one or several declarations, or null.
  const std::vector<std::string>* find_object_types(std::string_view name) const;
  bool is_derived(std::string_view name) const { return derived_.contains(name); }
  const TypeTree& types() const { return types_; }

 private:
  using Signatures = std::unordered_map<std::string_view, const Signature*>;

  Signatures predicates_;
  Signatures fluents_;
  Signatures externals_;
  std::unordered_map<std::string_view, std::vector<std::string>> objects_;
  std::unordered_set<std::string_view> derived_;
  TypeTree types_;
  Unread unread_;

  // Comparing an unknown name with all known ones takes time; a text with more of them than these has other troubles.
  bool may_compare() const { return comparisons_left_ > 0 && comparisons_left_-- > 0; }
  mutable int comparisons_left_ = 200;
};

/// Walks conditions, effects and expressions with the variables bound so far. `Symbols` and `Findings` must
/// outlive it.
class FormulaChecker {
 public:
  FormulaChecker(const Symbols& symbols, Findings& findings) : symbols_(symbols), findings_(findings) {}

  /// Binds variables for the checks that follow, until unbind() with the same ones.
  void bind(const std::vector<TypedName>& variables);
  void unbind(const std::vector<TypedName>& variables);

  void check_fact(const Atom& atom);        ///< predicate, arity, arguments
  void check_basic_fact(const Atom& atom);  ///< … and not derived: what effects and :init may set
  void check_fluent(const Atom& atom);      ///< a fluent that may be assigned
  void check_expression(const Expression& expression, ExpressionContext context);
  void check_condition(const Condition& condition);
  void check_timed(const TimedCondition& condition);
  void check_effects(const std::vector<Effect>& effects, ExpressionContext context);

 private:
  void check_arguments(const Atom& atom, const Signature& signature, std::string_view what);
  void check_argument(const Term& term, const TypedName& parameter, const Atom& atom, std::string_view what);
  bool is_bound(std::string_view name) const;
  const TypedName* find_variable(std::string_view name) const;
  std::string remedy_for_variable(const std::string& name) const;

  const Symbols& symbols_;
  Findings& findings_;
  std::vector<const TypedName*> bound_;  // the innermost one last
};

/// Reports every type of the names that nobody declared.
void check_types(const std::vector<TypedName>& names, const Symbols& symbols, Findings& findings);

/// Checks the types of the variables, and that none stands twice.
void check_variables(const std::vector<TypedName>& variables, const Symbols& symbols, Findings& findings);

/// These check what could be read; what is unknown there because something could not be read is not told.
std::vector<Diagnostic> check(const Domain& domain, const Unread& unread);
std::vector<Diagnostic> check(const Problem& problem, const Domain& domain, const Unread& unread);

}  // namespace roci::pddl
