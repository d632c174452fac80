// What a planner of the Europa lander would plan with if it knew the world:
// the parameters of its network as a flight has shown them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/model/network.hpp"
#include "tests/scenario/europa_course.hpp"
#include "tests/scenario/heard_flight.hpp"

namespace roci::scenario {

/// Returns the network with what the flight has shown to be true: durations and powers of the tasks, what is always on,
/// sizes of the data, and the rate of downlinks from `since_s` on, with the lengths that they need then.
/// Where there are `signatures` of samples (true or false by "site_target"), nobody asks for those to which the subway
/// map leads no more. The version is one higher.
planner::utility_htn::model::Network truth_of(planner::utility_htn::model::Network foreseen,
                                              const HeardFlight& flight, double since_s,
                                              const std::map<std::string, bool>& signatures);

/// Returns the utility of all data that were received on Earth, by rank, as the network values them.
std::vector<double> received(const planner::utility_htn::model::Network& network, const Course& course);

}  // namespace roci::scenario
