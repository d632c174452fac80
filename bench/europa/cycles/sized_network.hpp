// Networks of any size, made of Reference Surface Mission 1's own text.
#pragma once

#include <cstddef>
#include <filesystem>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::bench::europa {

/// Returns the network of `mission`/network-rsm1.yaml with so many sites and targets. Battery, length of the mission,
/// views of Earth, uplinks, panoramas and seismographs grow with the sites, so that the same share of all that could be
/// done can be paid for. Three sites of three targets are the mission as it stands. Throws std::runtime_error where its
/// text is no longer what this knows, and what load_network() throws.
planner::utility_htn::model::Network sized_network(const std::filesystem::path& mission, std::size_t sites,
                                                   std::size_t targets);

}  // namespace roci::bench::europa
