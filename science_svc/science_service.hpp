// This is the detector as a process: images come in, opportunistic goals go out (R54).
#pragma once

#include <memory>

#include "services/service.hpp"

namespace roci::science {

/// Makes the service. Throws mission::FileError when mission or scenario cannot be read.
std::unique_ptr<services::Service> make_service(services::Node&, const services::RunSettings&);

}  // namespace roci::science
