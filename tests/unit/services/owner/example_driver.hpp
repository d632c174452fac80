// The owner of services/owner/README.md.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace roci::example {

std::unique_ptr<services::Service> make_drill(services::Node&);

}  // namespace roci::example
