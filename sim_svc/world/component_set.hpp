// The component set lets the components of a robot find each other.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace roci::sim::world {

class Component;

/// Holds the components of one robot, as they see each other, in the order of the mission file.
class ComponentSet {
 public:
  void add(std::string name, const Component* component) { all_.emplace_back(std::move(name), component); }

  /// Returns the component of that name, or null if there is none.
  const Component* named(std::string_view name) const {
    for (const auto& [own, component] : all_) {
      if (own == name) return component;
    }
    return nullptr;
  }

  /// Returns the first component with the capability (capabilities.hpp), or null if none has it.
  template <class Capability>
  const Capability* find() const {
    for (const auto& [name, component] : all_) {
      if (const auto* able = dynamic_cast<const Capability*>(component)) return able;
    }
    return nullptr;
  }

  /// Returns all components with the capability.
  template <class Capability>
  std::vector<const Capability*> all() const {
    std::vector<const Capability*> out;
    for (const auto& [name, component] : all_) {
      if (const auto* able = dynamic_cast<const Capability*>(component)) out.push_back(able);
    }
    return out;
  }

 private:
  std::vector<std::pair<std::string, const Component*>> all_;
};

}  // namespace roci::sim::world
