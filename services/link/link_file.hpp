// This file reads the links of a scenario.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/mission/entry.hpp"
#include "core/mission/service_list.hpp"
#include "services/link/link_table.hpp"

namespace roci::services::link {

/// Reads `links:` of a scenario (docs/links.md). Throws mission::FileError with place and remedy for an
/// unknown key or end, a pair of ends or a name that stands twice, a loss outside 0 to 1, a light time or a
/// rate that none has, and windows or cuts out of order.
LinkTable read_links(const mission::Entry& scenario, const mission::ServiceList&, std::uint64_t seed);

/// Reads them from scenarios/<scenario>.yaml of a mission folder. A mission without that file has no links: a
/// robot of hardware needs no scenario.
LinkTable load_links(const std::filesystem::path& mission_folder, const std::string& scenario,
                     std::uint64_t seed);

}  // namespace roci::services::link
