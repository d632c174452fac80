#include "sim_svc/setup/registry.hpp"

#include <stdexcept>
#include <utility>

namespace roci::sim::setup {

void Registry::add(const std::string& type, ComponentType kind) {
  if (!types_.emplace(type, std::move(kind)).second) {
    throw std::invalid_argument("component type '" + type + "' is registered already");
  }
}

const ComponentType* Registry::find(std::string_view type) const {
  const auto found = types_.find(type);
  return found == types_.end() ? nullptr : &found->second;
}

std::vector<std::string> Registry::types() const {
  std::vector<std::string> out;
  for (const auto& [type, kind] : types_) out.push_back(type);
  return out;
}

}  // namespace roci::sim::setup
