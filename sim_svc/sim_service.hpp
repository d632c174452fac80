// This is the simulated robot as a process: commands come in, and acknowledgements, observations, products
// and hazards go out, on the topics that a real robot would serve; so do the scenario's stimuli.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace roci::sim {

/// Makes the service. Throws mission::FileError when mission or scenario cannot be read.
std::unique_ptr<services::Service> make_service(services::Node&, const services::RunSettings&);

}  // namespace roci::sim
