// A plan as a picture.
#pragma once

#include <string>
#include <string_view>

#include "planner_svc/temporal_pddl/extraction/plan.hpp"

namespace roci::planner::temporal_pddl::cli {

/// Returns an SVG document: the activities as bars over time in seconds, in the schedule of earliest times,
/// one colour for each action of the domain, named below. A lane is for what shares its first object (who does it, in
/// most domains), or without objects for the action; activities of a lane that overlap stand in rows below one
/// another.
std::string to_svg(const extraction::Plan& plan, std::string_view title);

}  // namespace roci::planner::temporal_pddl::cli
