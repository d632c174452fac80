// This file is internal to core/pddl: its functions lead each piece of the grammar from the skeleton
// (sexpr.hpp) to the tree (ast.hpp). All of them throw ParseError. `Source` stands for the file in their
// messages.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/sexpr.hpp"

namespace roci::pddl::grammar {

/// Names the file that is read, and throws ParseError for it.
class Source {
 public:
  explicit Source(std::string_view file) : file_(file) {}

  const std::string& file() const { return file_; }
  [[noreturn]] void fail(SourceLocation where, std::string message, std::string remedy) const;

 private:
  std::string file_;
};

/// Returns what follows the head of a list.
std::span<const Sexpr> rest(const Sexpr& list, std::size_t skip = 1);

// ---- grammar_terms.cpp

/// Reads a name; `what` names the thing in messages ("a predicate"), here and below.
std::string read_name(const Sexpr& s, std::string_view what, const Source& source);
double read_number(const Sexpr& s, std::string_view what, const Source& source);
const Sexpr& require_list(const Sexpr& s, std::string_view what, const Source& source);
std::vector<TypedName> read_typed_names(std::span<const Sexpr> items, std::string_view what,
                                        const Source& source);
std::vector<TypedName> read_variables(const Sexpr& list, const Source& source);
Atom read_atom(const Sexpr& s, std::string_view what, const Source& source);
/// Reads `(f a …)`, or the bare name of a function without parameters.
Atom read_function(const Sexpr& s, const Source& source);
Signature read_signature(const Sexpr& s, std::string_view what, const Source& source);
/// Reads a section that holds functions: `(f ?x - t) … [- number]`.
std::vector<Signature> read_functions(std::span<const Sexpr> items, const Source& source);

// ---- grammar_expressions.cpp

/// Reads a numeric expression.
Expression read_expression(const Sexpr& s, const Source& source);
std::optional<ComparisonOperator> as_comparison(std::string_view word);

// ---- grammar_conditions.cpp

/// Reads the condition of a plain action or a goal; the other function sorts that of a durative action by
/// time.
Condition read_condition(const Sexpr& s, const Source& source);
TimedCondition read_timed_condition(const Sexpr& s, const Source& source);

// ---- grammar_effects.cpp

/// Reads effects of one moment; the conditions of their `when` belong to the same moment.
std::vector<Effect> read_effects(const Sexpr& s, TimePoint moment, const Source& source);

/// Holds the effects of a durative action by the time at which they happen.
struct DurativeEffects {
  std::vector<Effect> at_start;
  std::vector<Effect> at_end;
  std::vector<Effect> continuous;
};
/// Reads the effects of a durative action.
DurativeEffects read_durative_effects(const Sexpr& s, const Source& source);

// ---- grammar_actions.cpp

/// These read an action from its `(:action …)` or `(:durative-action …)`.
Action read_action(const Sexpr& s, const Source& source);
DurativeAction read_durative_action(const Sexpr& s, const Source& source);

// ---- Shared by domain and problem

/// Checks `(define (KIND NAME) …` and returns NAME.
std::string read_define(const Sexpr& s, std::string_view kind, const Source& source);
std::vector<Requirement> read_requirements(const Sexpr& s, const Source& source);

}  // namespace roci::pddl::grammar
