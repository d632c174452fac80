// This file joins cases for std::visit.
#pragma once

namespace roci::sim::world {

/// Accepts whatever one of its cases takes, for std::visit.
template <class... Cases>
struct Match : Cases... {
  using Cases::operator()...;
};

}  // namespace roci::sim::world
