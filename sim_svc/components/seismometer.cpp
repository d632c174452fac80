#include "sim_svc/components/seismometer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using temporal::to_seconds;
using world::Ending;
using world::Surroundings;

namespace {

constexpr double kDay_s = 86400;
constexpr char kSince[] = "recording_since_us";

}  // namespace

Seismometer::Seismometer(SeismometerSettings settings, world::RandomStream noise)
    : settings_(std::move(settings)), noise_(std::move(noise)) {}

State Seismometer::state() const { return {recording_since_ ? "recording" : "parked", {}}; }

Ending Seismometer::begin(const world::Task& task, Time now, Surroundings& around) {
  results_.clear();
  const bool there = (task.command == "start") == recording_since_.has_value();
  const double usual_s = task.command == "start" ? settings_.start_s : settings_.park_s;
  const double factor = settings_.duration_factor * noise_.factor(settings_.duration_noise);
  work_.start(temporal::seconds(there ? 0 : usual_s * factor), now);
  run_ = task;
  around.effects.push_back({task.command, ""});
  return std::nullopt;
}

std::optional<Time> Seismometer::next_change() const {
  if (!run_) return std::nullopt;
  return work_.end();
}

Ending Seismometer::finish(Surroundings& around) {
  const world::Task done = *std::exchange(run_, std::nullopt);
  if (hollow_.take(done.command)) return std::nullopt;
  if (done.command == "park") return park(done.key, work_.end(), around);
  if (!recording_since_) recording_since_ = work_.end();
  return std::nullopt;
}

Ending Seismometer::park(const world::TaskKey& key, Time now, Surroundings& around) {
  if (!recording_since_) return std::nullopt;
  const Time since = *std::exchange(recording_since_, std::nullopt);
  const double recorded_s = to_seconds(now - since);
  const double quakes = quakes_in(since, now);
  results_ = {{"recorded_s", recorded_s}, {"quakes", quakes}};
  const double usual = settings_.quakes_per_day * settings_.reference_s / kDay_s;
  const double content = settings_.quiet_share * recorded_s / settings_.reference_s +
                         (1 - settings_.quiet_share) * (usual > 0 ? quakes / usual : 0);
  return make_products(settings_.products, key, {}, content, now, noise_, around);
}

// Each day has quakes of its own, whenever it is recorded: their number is drawn by Poisson (Knuth, "The art of
// computer programming", 3.4.1), for small averages, and each has its time.
double Seismometer::quakes_in(Time from, Time to) const {
  double out = 0;
  const auto first = static_cast<std::int64_t>(to_seconds(from) / kDay_s);
  const auto last = static_cast<std::int64_t>(to_seconds(to) / kDay_s);
  for (std::int64_t day = first; day <= last; ++day) {
    world::RandomStream sky = noise_.branch("day " + std::to_string(day));
    const double begin = static_cast<double>(day) * kDay_s;
    double left = settings_.quakes_per_day;
    for (left += std::log(1 - sky.uniform()); left > 0; left += std::log(1 - sky.uniform())) {
      const double at = begin + kDay_s * sky.uniform();
      if (at >= to_seconds(from) && at < to_seconds(to)) ++out;
    }
  }
  return out;
}

double Seismometer::energy_j(Time from, Time to) const {
  const double watts = (run_ ? settings_.switch_w : 0) + (recording_since_ ? settings_.record_w : 0);
  return watts * to_seconds(to - from);
}

double Seismometer::peak_power_w() const { return settings_.switch_w + settings_.record_w; }

world::Memory Seismometer::memory() const {
  if (!recording_since_) return {};
  return {{kSince, static_cast<double>(recording_since_->count())}};
}

void Seismometer::restore(const world::Memory& memory) {
  const auto since = memory.find(kSince);
  const auto* count = since == memory.end() ? nullptr : std::get_if<double>(&since->second);
  if (count && *count >= 0 && *count < 1e18) recording_since_ = Time(static_cast<std::int64_t>(*count));
}

}  // namespace roci::sim::components
