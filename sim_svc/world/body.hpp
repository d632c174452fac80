// The body is what a simulated robot has beside its components.
#pragma once
#include <optional>

#include "sim_svc/world/battery.hpp"
#include "sim_svc/world/data_store.hpp"
#include "sim_svc/world/image_store.hpp"
#include "sim_svc/world/thermal.hpp"
#include "sim_svc/world/values.hpp"

namespace roci::sim::world {

/// Holds what a robot has once, whatever its components are.
struct Body {
  std::optional<Pose> pose;             ///< empty: it stands nowhere on the map
  std::optional<Battery> battery;       ///< empty: its power comes from elsewhere and never ends
  ImageStore images;                    ///< are on board, or were sent
  std::optional<Thermal> thermal{};     ///< empty: it is warm enough everywhere
  std::optional<DataStore> data{};      ///< empty: nothing can be kept but images
};

}  // namespace roci::sim::world
