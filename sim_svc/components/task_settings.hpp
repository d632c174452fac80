// This file reads the settings of a component that is data alone, in mission and scenario files.
#pragma once
#include "sim_svc/components/task.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a component of type `task` (README.md). Throws mission::FileError.
TaskSettings read_task_settings(setup::Settings&);

}  // namespace roci::sim::components
