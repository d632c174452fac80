// Bindings say which object each variable stands for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Maps variables to objects, the latest binding first out. It refers to names that belong to the domain, the
/// problem or the plan, which must outlive it.
class Bindings {
 public:
  void push(std::string_view variable, std::string_view object) { pairs_.push_back({variable, object}); }
  void pop() { pairs_.pop_back(); }

  /// Returns the object of a term; a constant stands for itself. Throws std::logic_error for an unbound
  /// variable, which check() excludes.
  std::string_view object_of(const pddl::Term& term) const;
  /// Returns the ground atom in the form in which facts and values are kept: "(at rover base)". Throws as
  /// object_of() does.
  std::string ground(const pddl::Atom& atom) const;
  /// Returns printed PDDL with its bound variables replaced; unbound ones stay as they are.
  std::string instantiate(std::string_view printed) const;

 private:
  struct Pair {
    std::string_view variable;
    std::string_view object;
  };
  std::vector<Pair> pairs_;
};

}  // namespace roci::planner::temporal_pddl::validate
