// Which object each variable stands for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Refers to names that belong to the domain, the problem or the plan: they must outlive it.
class Bindings {
 public:
  void push(std::string_view variable, std::string_view object) { pairs_.push_back({variable, object}); }
  void pop() { pairs_.pop_back(); }

  /// A constant stands for itself. Throws std::logic_error for an unbound variable, which check() excludes.
  std::string_view object_of(const pddl::Term& term) const;
  /// "(at rover base)": the form in which facts and values are kept.
  std::string ground(const pddl::Atom& atom) const;
  /// Printed PDDL with the bound variables replaced.
  std::string instantiate(std::string_view printed) const;

 private:
  struct Pair {
    std::string_view variable;
    std::string_view object;
  };
  std::vector<Pair> pairs_;
};

}  // namespace roci::planner::temporal_pddl::validate
