#include "exec_svc/goals/goal_merge.hpp"

#include <algorithm>

namespace roci::exec::goals {
namespace {

// Returns whether both ask for the same, recalled or not.
bool same_wish(GoalRequest one, const GoalRequest& other) {
  one.recalled = other.recalled;
  return same_request(one, other);
}

bool same_record(const GoalRecord& one, const GoalRecord& other) {
  return one.request == other.request && one.state == other.state && one.revision == other.revision;
}

// Returns the goal's state here: one that is in another executive's plan is not planned here.
GoalState state_of(const GoalRecord& record) {
  return is_final(record.state) ? record.state : GoalState::pending;
}

}  // namespace

std::optional<GoalRecord> merged(const GoalRecord& ours, const GoalRecord& theirs) {
  if (theirs.state == GoalState::rejected) return std::nullopt;
  GoalRecord out = ours;
  const bool same = same_wish(ours.request, theirs.request);
  const bool theirs_counts = ours.state == GoalState::rejected || (!same && theirs.revision > ours.revision);
  if (theirs_counts) {
    out.request = theirs.request;
    out.state = state_of(theirs);
    out.answers = theirs.answers;
    out.reason = "as the other executive took it in";
  } else if (same && theirs.state == GoalState::achieved && ours.state != GoalState::achieved) {
    out.state = GoalState::achieved;
    out.reason = "achieved by the other executive";
  }
  out.revision = std::max(ours.revision, theirs.revision);
  out.request.recalled = ours.request.recalled || theirs.request.recalled;
  if (theirs.request.recalled && !ours.request.recalled) out.answers = theirs.answers;
  if (out.request.recalled && out.state != GoalState::achieved && out.state != GoalState::recalled) {
    out.state = GoalState::recalled;
    out.reason = "recalled by " + out.request.key.issuer;
  }
  if (same_record(out, ours)) return std::nullopt;
  for (const SampleId& sample : theirs.before) note_before(out, sample);
  for (const SampleId& sample : {ours.answers, theirs.answers}) note_before(out, sample);
  return out;
}

}  // namespace roci::exec::goals
