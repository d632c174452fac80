// Goals are raised on board as observations come over DDS.
#pragma once
#include <memory>

#include "core/mission/entry.hpp"
#include "services/service.hpp"

namespace roci::science::watch {

/// Raises the goals that the section `watch` of the mission asks for (issuer: the node's name) and tells each as the
/// event watch.goal. Returns null where the mission watches nothing: it then subscribes to nothing. Throws
/// mission::FileError.
std::unique_ptr<services::Service> make_watch(services::Node& node, const mission::Entry& mission);

}  // namespace roci::science::watch
