// This file is internal to core/pddl: its functions lead each piece of the grammar from the skeleton
// (sexpr.hpp) to the tree (ast.hpp). Each throws ParseError where it has nothing to return; lists tell what is wrong
// with one of their parts to `Source` and go on with the next, so that what they return is whole only if the source
// counts no errors.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/sexpr.hpp"

namespace roci::pddl::grammar {

/// Stands for the text that is read: takes what is wrong or odd with it.
class Source {
 public:
  /// `log` must outlive the source.
  explicit Source(DiagnosticLog& log) : log_(log) {}

  const std::string& file() const { return log_.file(); }
  /// Throws ParseError with this one finding, for the next attempt() around.
  [[noreturn]] void fail(SourceLocation where, std::string message, std::string remedy) const;
  /// Does so for what may be right, but is not taken by anything in this tree.
  [[noreturn]] void refuse(SourceLocation where, std::string message, std::string remedy) const;
  /// These tell a finding and go on.
  void report(SourceLocation where, std::string message, std::string remedy) const;
  void warn(Departure departure, SourceLocation where, std::string message, std::string remedy) const;
  /// Counts what was reported, also by attempts.
  std::size_t errors() const { return log_.errors(); }

  /// Calls read() and reports the ParseError that it throws. Returns whether nothing was reported meanwhile.
  template <typename Read>
  bool attempt(Read read) const {
    const std::size_t before = errors();
    try {
      read();
    } catch (const ParseError& error) {
      if (log_.full()) throw;
      for (const Diagnostic& diagnostic : error.diagnostics()) log_.add(diagnostic);
    }
    return errors() == before;
  }

 private:
  DiagnosticLog& log_;
};

/// Returns the word as a string of its own, for names and messages.
inline std::string text(const Sexpr& s) { return std::string(s.word()); }

/// Returns what follows the head of a list.
std::span<const Sexpr> rest(const Sexpr& list, std::size_t skip = 1);

// ---- grammar_terms.cpp

/// Reads a name; `what` names the thing in messages ("a predicate"), here and below.
std::string read_name(const Sexpr& s, std::string_view what, const Source& source);
double read_number(const Sexpr& s, std::string_view what, const Source& source);
const Sexpr& require_list(const Sexpr& s, std::string_view what, const Source& source);
std::vector<TypedName> read_typed_names(std::span<const Sexpr> items, std::string_view what,
                                        const Source& source);
/// Reads `?x ?y - t …`; the other function reads it from a list.
std::vector<TypedName> read_variables(std::span<const Sexpr> items, const Source& source);
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

// ---- grammar_files.cpp: what domain and problem share

/// Checks `(define (KIND NAME) …` and returns NAME.
std::string read_define(const Sexpr& s, std::string_view kind, const Source& source);
/// Reads `(:requirements …)`; flags that are unknown, or of what is not supported, are told and left out.
std::vector<Requirement> read_requirements(const Sexpr& s, const Source& source);
/// These tell what is wrong with a section of another name than the known ones.
std::string unknown_section(const Sexpr& s, std::string_view kind);
std::string remedy_for_section(const Sexpr& s, std::span<const std::string_view> known);

}  // namespace roci::pddl::grammar
