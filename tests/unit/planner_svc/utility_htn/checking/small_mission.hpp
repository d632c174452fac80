// A small mission at two sites and a plan for it without any fault, to be damaged.
#pragma once

#include "planner_svc/utility_htn/checking/check.hpp"

namespace roci::planner::utility_htn::checking {

namespace timeline {
inline constexpr std::uint32_t battery = 0, phase = 1, arm = 2, memory = 3, excavated = 4, signature_0_0 = 5,
                               signature_0_1 = 6, signature_0_2 = 7, signature_1_0 = 8, signature_1_1 = 9;
}
namespace task {
inline constexpr std::uint32_t hotel = 0, excavate = 1, collect = 2, analyze = 3, downlink = 4, panorama = 5,
                               uplink = 6, sample_0_0 = 7, sample_0_1 = 8, sample_0_2 = 9, sample_1_0 = 10,
                               sample_1_1 = 11;
}

model::Network small_network();

/// Is a question that owns its network. Blocks: hotel load, panorama (both committed), sample_0_0, sample_0_1, uplink;
/// with a photo on board. It is 30 s, and the commit window ends at 60 s.
struct SmallMission {
  model::Network network = small_network();
  model::Values values{};
  std::vector<Block> plan;
  std::vector<Block> before;
  Downlinks downlinks;
  std::vector<Observation> observations{};
  double budget = 400;
  std::vector<model::TaskIndex> closed{};
  std::vector<model::TaskIndex> broken_off{};

  SmallMission();
  Block& block(model::TaskIndex request);
  Step& step(std::uint64_t id);
  Product& product(const std::string& id);
  std::vector<std::string> faults() const;
};

}  // namespace roci::planner::utility_htn::checking
