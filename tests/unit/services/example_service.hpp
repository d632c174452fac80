// The example of services/README.md, compiled and run by the tests.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace roci::example {

std::unique_ptr<services::Service> make_service(services::Node&, const services::RunSettings&);

}  // namespace roci::example
