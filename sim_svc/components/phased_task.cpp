#include "sim_svc/components/phased_task.hpp"

#include <algorithm>
#include <utility>

namespace roci::sim::components {

using temporal::Time;

void PhasedTask::begin(std::vector<Phase> phases, Time now, world::Body& body) {
  phases_ = std::move(phases);
  at_ = 0;
  enter(now, body);
}

void PhasedTask::change_rest(std::vector<Phase> rest, Time now, world::Body& body) {
  phases_.resize(at_);
  phases_.insert(phases_.end(), rest.begin(), rest.end());
  enter(now, body);
}

void PhasedTask::enter(Time now, world::Body& body) {
  const Phase& phase = phases_[at_];
  work_.start(temporal::seconds(phase.work_s), now);
  warm_ = now;
  settle(now, body);
}

void PhasedTask::leave(Time, world::Body&) {
  phases_.clear();
  at_ = 0;
}

std::optional<Time> PhasedTask::next_change() const {
  if (!busy()) return std::nullopt;
  return phases_[at_].until == Phase::Until::warm ? warm_ : work_.end();
}

bool PhasedTask::go_on(world::Body& body) {
  const Time now = *next_change();
  if (at_ + 1 == phases_.size()) {
    leave(now, body);
    return false;
  }
  ++at_;
  enter(now, body);
  return true;
}

void PhasedTask::halt(Time now, world::Body& body) {
  if (busy()) leave(now, body);
}

void PhasedTask::settle(Time, world::Body&) {}

double PhasedTask::energy_j(Time from, Time to) const {
  return busy() ? phases_[at_].power_w * temporal::to_seconds(to - from) : 0;
}

double PhasedTask::peak_power_w() const {
  double out = 0;
  for (std::size_t i = at_; i < phases_.size(); ++i) out = std::max(out, phases_[i].power_w);
  return out;
}

}  // namespace roci::sim::components
