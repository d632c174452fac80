// This is the path planner's process: what it answers over DDS.
#pragma once
#include <memory>

#include "services/service.hpp"

namespace roci::pathplan {

/// Makes the owner of module `pathplan` and of paths (README.md). Throws mission::FileError or
/// terrain::MapError when the mission's site or rover cannot be read.
std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings);

}  // namespace roci::pathplan
