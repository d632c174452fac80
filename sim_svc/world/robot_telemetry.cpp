// This file says when a robot's timelines are reported, and when it wakes the world.
#include <algorithm>

#include "sim_svc/world/robot.hpp"

namespace roci::sim::world {

using temporal::seconds;
using temporal::Time;

namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kMilliradian = 1e-3;
constexpr double kJoule = 1;
constexpr double kKelvin = 1;
constexpr double kLeastPower = 1e-3;  // W; nothing lasts for ever
constexpr double kLongestLife = 1e9;  // s

}  // namespace

Time Robot::next_change() const {
  Time best = next_report_;
  for (const Part& one : parts_) {
    if (const auto change = one.component->next_change()) best = std::min(best, *change);
    if (const auto routine = one.component->next_routine()) best = std::min(best, *routine);
  }
  return best;
}

std::optional<Time> Robot::flat_at(Time now) const {
  if (!body_.battery || flat()) return std::nullopt;
  double power = power_->idle_w;
  for (const Part& one : parts_) power += one.component->peak_power_w();
  if (body_.thermal) power += body_.thermal->peak_power_w();
  power *= std::max(1.0, power_->use_factor);
  return now + seconds(std::min(kLongestLife, body_.battery->energy_j() / std::max(kLeastPower, power)));
}

bool Robot::moves() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& one) { return one.component->moves(); });
}

void Robot::report_components(Time now, Reporter& reporter, Outputs& out) const {
  for (const Part& one : parts_) reporter.report(name_ + "." + one.name, one.component->state(), now, out);
}

void Robot::report_things(Time now, Reporter& reporter, Outputs& out) {
  for (const ImageStore::Change& image : body_.images.take_changes()) {
    const std::string timeline = name_ + ".image." + image.id;
    if (image.state == ImageStore::State::forgotten) {
      reporter.end(timeline, now, out);
    } else if (image.state == ImageStore::State::missing) {
      reporter.report(timeline, temporal::State{"missing", {}}, now, out);
      reporter.end(timeline, now, out);
    } else {
      const char* const state = image.state == ImageStore::State::sent ? "sent" : "stored";
      reporter.report(timeline, temporal::State{state, {}}, now, out);
    }
  }
  for (Part& one : parts_) {
    const auto version = one.component->states_version();
    if (version && version == one.states_reported) continue;
    one.states_reported = version;
    for (const NamedState& thing : one.component->states()) {
      reporter.report(name_ + "." + thing.name, thing.state, now, out);
    }
  }
}

void Robot::report_numbers_if_due(Time now, Reporter& reporter, Outputs& out) {
  const bool due = task_ended_ || now >= next_report_;
  task_ended_ = false;
  if (!due) return;
  if (body_.pose) {
    reporter.report_number(name_ + ".x", body_.pose->x, kMillimetre, now, out);
    reporter.report_number(name_ + ".y", body_.pose->y, kMillimetre, now, out);
    reporter.report_number(name_ + ".heading", body_.pose->heading, kMilliradian, now, out);
  }
  if (body_.battery) {
    reporter.report_number(name_ + ".battery", told_j(power_->gauge, body_.battery->energy_j()), kJoule, now,
                           out);
  }
  if (body_.thermal) {
    for (const ZoneParameters& zone : body_.thermal->zones())
      reporter.report_number(name_ + ".heat." + zone.name, body_.thermal->temperature_k(zone.name, now),
                             kKelvin, now, out);
  }
  for (const Part& one : parts_) {
    for (const NamedNumber& number : one.component->numbers()) {
      reporter.report_number(name_ + "." + one.name + "." + number.name, number.value, number.resolution, now,
                             out);
    }
  }
  next_report_ = now + seconds(moves() ? telemetry_.moving_s : telemetry_.idle_s);
}

void Robot::hasten_numbers(Time now) {
  if (moves()) next_report_ = std::min(next_report_, now + seconds(telemetry_.moving_s));
}

}  // namespace roci::sim::world
