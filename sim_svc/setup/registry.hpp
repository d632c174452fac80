// The registry has the component types that a mission may name, and who reads their settings.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim_svc/setup/settings.hpp"
#include "sim_svc/world/robot.hpp"

namespace roci::sim::setup {

/// Reads a component's settings, and says how to make it. It keeps values, no entry of a file.
using ReadComponent = std::function<world::MakeComponent(Settings&)>;

/// Describes one kind of component, as mission.yaml names it by `type`.
struct ComponentType {
  ReadComponent read;
  bool on_ground = false;      ///< its robot needs a place on the map at the start, and the mission a site
  bool can_be_slowed = false;  ///< its tasks can be slowed by a fault (Component::slow_down)
  bool can_be_hollow = false;  ///< its tasks can succeed without effect (Component::hollow_next)
  bool has_rate = false;       ///< it sends data, at a rate that can change (Component::change_rate)
};

/// Holds the types of components that a mission may name. components/standard_types.hpp has those that come
/// with the simulator; a test or another program adds its own.
class Registry {
 public:
  /// Adds a type. Throws std::invalid_argument when there is one of that name.
  void add(const std::string& type, ComponentType);
  /// Returns the type of that name, or null if there is none.
  const ComponentType* find(std::string_view type) const;
  std::vector<std::string> types() const;  ///< in alphabetical order

 private:
  std::map<std::string, ComponentType, std::less<>> types_;
};

}  // namespace roci::sim::setup
