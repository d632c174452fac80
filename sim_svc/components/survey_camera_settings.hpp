// This file reads the settings of a survey camera in mission and scenario files.
#pragma once
#include "sim_svc/components/survey_camera.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a survey camera (README.md). Throws mission::FileError with place and remedy.
SurveyCameraSettings read_survey_camera_settings(setup::Settings&);

}  // namespace roci::sim::components
