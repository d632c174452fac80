#include "planner_svc/timeline_htn/checking/parts.hpp"

namespace roci::planner::timeline_htn::checking {

using model::StateKind;

namespace {

/// Knows which values belong to what mends an error, and which their timelines cannot do without behind those.
class Mending {
 public:
  explicit Mending(const Version& version) : version_(version) {
    for (const std::vector<Value>& timeline : version.timelines)
      owner_.emplace_back(timeline.size(), nullptr);
    for (const Part& part : version.parts)
      if (part.value && version.definition(*part.state).kind != StateKind::resting)
        owner_[part.state->component][*part.value] = &part;
  }

  bool is_mending(const Part& part) const {
    const Part* top = &part;
    while (top->parent != kNone) top = &version_.parts[top->parent];
    return !top->state;
  }

  /// Returns whether the value is what its timeline goes on with at once,
  /// behind the mending or what ran when the plan began.
  bool goes_on(const Part& part) const {
    if (!part.value || version_.definition(*part.state).kind == StateKind::complex) return false;
    const std::vector<Value>& values = version_.timelines[part.state->component];
    for (Index i = *part.value; i > 0; --i) {
      const StateKind before = version_.definition(values[i - 1].state).kind;
      if (before == StateKind::resting || before == StateKind::error) return false;
      const Part* owner = owner_[part.state->component][i - 1];
      if (i == 1 || (owner != nullptr && is_mending(*owner))) return true;
    }
    return false;
  }

 private:
  const Version& version_;
  std::vector<std::vector<const Part*>> owner_;
};

}  // namespace

void check_mending(const Version& version, Faults& out) {
  const Mending mending(version);
  for (const Part& mends : version.parts) {
    if (mends.state || mends.parent != kNone) continue;
    for (const Part& part : version.parts)
      if (!mending.is_mending(part) && !mending.goes_on(part) &&
          !version.network.implies(mends.end(), part.start(), Duration{0}, temporal::no_bound))
        out.push_back(version.text(part) + " may start before " + version.text(mends) +
                      " has ended, and everything else follows what mends");
  }
}

}  // namespace roci::planner::timeline_htn::checking
