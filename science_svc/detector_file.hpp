// This file reads the settings of the detector in mission and scenario files.
#pragma once
#include "core/mission/entry.hpp"
#include "science_svc/detector.hpp"

namespace roci::science {

/// Reads the section `science` of mission.yaml and, over it, that of the scenario (`enabled`, `threshold`, `limit`). A
/// mission without the section has no detector. Throws mission::FileError with place and remedy.
DetectorSettings read_detector(const mission::Entry& mission, const mission::Entry& scenario);

}  // namespace roci::science
