#include "sim_svc/world/component.hpp"

#include <algorithm>

namespace roci::sim::world {

std::vector<std::string> CommandForm::missing(const std::function<bool(const std::string&)>& is_given) const {
  const bool replaced = !instead.empty() && is_given(instead);
  std::vector<std::string> out;
  for (const std::string& one : arguments)
    if (!is_given(one) && !(replaced && std::ranges::find(spared, one) != spared.end())) out.push_back(one);
  return out;
}

Ending Component::answer(const Answer&, temporal::Time, Surroundings&) {
  return Failure{"unasked", "the component has asked for nothing"};
}

}  // namespace roci::sim::world
