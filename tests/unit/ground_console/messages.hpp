// Messages of a small mission as they come down: two goals, a plan of two activities, a robot, events.
#pragma once

#include <string>

#include "ground_console/lib/mission_view.hpp"

namespace roci::console::testing {

// Sent by `sender` as its number `seq` at mission time `s`.
v1::SampleHeader sent(const std::string& sender, std::uint64_t seq, double s, std::uint32_t incarnation = 1);

v1::GoalStatus goal_status(const std::string& id, v1::GoalState state, std::uint64_t seq,
                           const std::string& reason = "");
v1::Event event(const std::string& text, double s, v1::Severity severity = v1::SEVERITY_INFO);
v1::Observation observation(const std::string& timeline, const std::string& state, std::uint64_t seq);
v1::Observation number(const std::string& timeline, double value, double s);
v1::Goal goal(const std::string& id, const std::string& x, const std::string& y);
v1::StepStatus step(const std::string& activity, v1::ActivityState state, std::uint64_t seq, double from_s,
                    double started_s, double ended_s);

// The mission at 300 s: the drive is over, the image is being taken.
lib::MissionView flying_mission();

}  // namespace roci::console::testing
