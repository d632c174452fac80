// Programs of others take part in a rehearsal: rocinante_service() builds beside each program a file that holds the
// same service.
#pragma once

#include <filesystem>
#include <stdexcept>

#include "services/service.hpp"

namespace roci::rehearsal {

/// Says which service cannot be started in this process, and the remedy.
class NotLoadable : public std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Loads the service that stands in `program` with ".so" behind it; it stays loaded. Throws NotLoadable if there is
/// no such file, it holds no service, or it was built with another Rocinante than this one.
services::MakeService* load_service(const std::filesystem::path& program);

}  // namespace roci::rehearsal
