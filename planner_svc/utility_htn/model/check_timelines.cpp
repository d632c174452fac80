#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/complaints.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"

namespace roci::planner::utility_htn::model {

using temporal::timelines::Definition, temporal::timelines::Kind;

namespace {

void check_states(const Definition& timeline, Complaints& complaints) {
  complaints.more_than("states", timeline.states.size(), kMostStates);
  if (timeline.states.empty()) complaints.error("it has no states", "list them");
  std::set<std::string_view> seen;
  for (const std::string& state : timeline.states) {
    complaints.name("state", state);
    if (!seen.insert(state).second)
      complaints.error("state '" + state + "' stands there twice", "rename one");
  }
  if (!(timeline.initial >= 0 && timeline.initial < static_cast<double>(timeline.states.size())) ||
      timeline.initial != std::floor(timeline.initial))
    complaints.error("its initial value is none of its states", "name one of them");
  if (std::isfinite(timeline.lowest) || std::isfinite(timeline.highest))
    complaints.error("it has states and a range of numbers", "leave one of them out");
}

void check_numbers(const Definition& timeline, Complaints& complaints) {
  if (!timeline.states.empty())
    complaints.error("it has states, and is of kind " + std::string(to_text(timeline.kind)),
                     "make it of kind state, or leave them out");
  if (std::isnan(timeline.lowest) || std::isnan(timeline.highest) || timeline.lowest > timeline.highest)
    complaints.error("its range holds no value", "write the lower bound first");
  else if (!std::isfinite(timeline.initial) || timeline.initial < timeline.lowest ||
           timeline.initial > timeline.highest)
    complaints.error("its initial value " + to_text(timeline.initial) + " is not within its range " +
                         to_text(timeline.lowest) + " .. " + to_text(timeline.highest),
                     "mend the value or the range");
  if (timeline.kind == Kind::atomic &&
      (timeline.lowest != 0 || timeline.highest != 1 || (timeline.initial != 0 && timeline.initial != 1)))
    complaints.error("it is atomic, and its range is not 0 .. 1", "leave range and initial value out");
  if (timeline.kind == Kind::claimable &&
      (!std::isfinite(timeline.lowest) || !std::isfinite(timeline.highest)))
    complaints.error("it is claimable, and there is no end to what can be claimed", "give it a range");
}

}  // namespace

void check_timelines(Complaints& complaints) {
  std::set<std::string_view> seen;
  const auto& timelines = complaints.network.timelines;
  for (std::size_t index = 0; index < timelines.size(); ++index) {
    const Definition& timeline = timelines[index];
    complaints.about(Part::timeline, index);
    complaints.name("the timeline's name", timeline.name);
    if (!seen.insert(timeline.name).second)
      complaints.error("the name is that of another timeline", "rename one");
    if (timeline.kind == Kind::state) {
      check_states(timeline, complaints);
    } else {
      check_numbers(timeline, complaints);
    }
  }
}

}  // namespace roci::planner::utility_htn::model
