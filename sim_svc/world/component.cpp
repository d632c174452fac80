#include "sim_svc/world/component.hpp"

namespace roci::sim::world {

Ending Component::answer(const Answer&, temporal::Time, Surroundings&) {
  return Failure{"unasked", "the component has asked for nothing"};
}

}  // namespace roci::sim::world
