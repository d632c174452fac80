// Overloaded lets std::visit take one lambda per alternative.
#pragma once

namespace roci::pddl {

/// Accepts whatever one of its lambdas takes.
template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace roci::pddl
