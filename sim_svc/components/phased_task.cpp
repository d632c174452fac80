#include "sim_svc/components/phased_task.hpp"

#include <algorithm>
#include <utility>

namespace roci::sim::components {

using temporal::Time;

world::Ending PhasedTask::begin(std::vector<Phase> phases, Time now, world::Body& body) {
  phases_ = std::move(phases);
  at_ = 0;
  if (world::Thermal* thermal = heat(body)) thermal->hold(zone_, this, now);
  enter(now, body);
  if (next_change()) return std::nullopt;
  leave(now, body);
  return world::Failure{"too-cold", "the heater cannot make '" + zone_ + "' warm enough for work"};
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
  if (world::Thermal* thermal = heat(body)) thermal->set_waste(zone_, this, phase.heat_w, now);
  settle(now, body);
}

void PhasedTask::leave(Time now, world::Body& body) {
  if (world::Thermal* thermal = heat(body)) thermal->release(zone_, this, now);
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

void PhasedTask::settle(Time now, world::Body& body) {
  const world::Thermal* thermal = heat(body);
  if (thermal && busy() && phases_[at_].until == Phase::Until::warm) warm_ = thermal->ready_at(zone_, now);
}

double PhasedTask::energy_j(Time from, Time to) const {
  return busy() ? phases_[at_].power_w * temporal::to_seconds(to - from) : 0;
}

double PhasedTask::peak_power_w() const {
  double out = 0;
  for (std::size_t i = at_; i < phases_.size(); ++i) out = std::max(out, phases_[i].power_w);
  return out;
}

}  // namespace roci::sim::components
