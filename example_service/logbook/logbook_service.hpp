// A listener: it writes down what the mission's services say.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace borehole {

// Writes logbook.txt in the run folder: a line for each event and for each word on a command,
// with its mission time in seconds.
std::unique_ptr<roci::services::Service> make_logbook(roci::services::Node& node,
                                                      const roci::services::RunSettings& settings);

}  // namespace borehole
