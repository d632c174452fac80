// An idle service belongs to the clock's roster, hears what most services hear and has nothing to do.
#pragma once

#include "services/service.hpp"

namespace roci::bench::house {

services::MakeService make_idle_service;

}  // namespace roci::bench::house
