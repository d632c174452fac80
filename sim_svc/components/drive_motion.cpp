#include "sim_svc/components/drive_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roci::sim::components {

using temporal::seconds;
using temporal::Time;
using temporal::to_seconds;
using world::Ground;
using world::Pose;
using world::RandomStream;
using world::Rock;

namespace {

constexpr double kStepSeconds = 0.1;
constexpr double kTurnInPlaceRad = 0.3;   // a larger error of the heading is turned out on the spot
constexpr double kPassedWaypoint = 0.1;   // metres
constexpr double kSlipMemorySeconds = 8;  // correlation time of the slip's noise
constexpr double kPatienceSeconds = 90;   // without progress for so long, the rover is stuck
constexpr double kProgressMetres = 0.05;
constexpr double kMaxSlip = 0.95;
constexpr double kDigInSeconds = 20;  // of spinning wheels, after which the body is dug in for good

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

bool here_is(const Pose& pose, terrain::Point p) { return pose.x == p.x && pose.y == p.y; }

double distance_to_segment(terrain::Point p, terrain::Point a, terrain::Point b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  return terrain::distance(p, {a.x + t * dx, a.y + t * dy});
}

class DriveIntegration {
 public:
  DriveIntegration(const Ground& ground, const DriveParameters& parameters, const Pose& from,
                   const std::vector<terrain::Point>& way, std::size_t first, RandomStream& noise,
                   SoilSensor* sensor)
      : ground_(ground), p_(parameters), way_(way), noise_(noise), sensor_(sensor) {
    now_.pose = from;
    now_.next_waypoint = first;
    started_in_rock_ = in_rock();
  }

  DriveTrace run(Time start) {
    DriveTrace trace;
    trace.start = start;
    trace.samples.push_back(now_);
    double last_step = 0;  // seconds
    while (!finished(trace)) {
      last_step = step();
      trace.samples.push_back(now_);
      trace.peak_power_w = std::max(trace.peak_power_w, power_w_);
    }
    trace.deepest_sinkage_m = deepest_sinkage_m_;
    trace.most_soil_slip = most_soil_slip_;
    trace.no_go = no_go_;
    if (sensor_) trace.soil = sensor_->record();
    const auto whole = static_cast<std::int64_t>(trace.samples.size()) - 2;
    trace.end = whole < 0 ? start : start + whole * kDriveStep + seconds(last_step);
    return trace;
  }

 private:
  terrain::Point here() const { return {now_.pose.x, now_.pose.y}; }
  bool in_rock() const { return ground_.site->occupancy(here()) == terrain::Occupancy::occupied; }

  bool finished(DriveTrace& trace) {
    if (no_go_) {
      trace.outcome = DriveEnd::no_go;
      return true;
    }
    while (now_.next_waypoint + 1 < way_.size() &&
           terrain::distance(here(), way_[now_.next_waypoint]) < kPassedWaypoint) {
      ++now_.next_waypoint;
      best_distance_ = INFINITY;
    }
    if (now_.next_waypoint >= way_.size() ||
        (now_.next_waypoint + 1 == way_.size() && here() == way_.back())) {
      trace.outcome = DriveEnd::arrived;
      return true;
    }
    trace.seen_rock = rock_on_the_way();
    if (trace.seen_rock) trace.outcome = DriveEnd::blocked;
    if (!trace.seen_rock && !started_in_rock_ && in_rock()) trace.outcome = DriveEnd::collision;
    if (!made_progress()) trace.outcome = DriveEnd::stuck;
    if (spun_s_ >= kDigInSeconds) trace.outcome = DriveEnd::bogged;
    return trace.outcome != DriveEnd::arrived;
  }

  // Returns the first hidden rock that the rover would touch on the way-points within its sight.
  std::optional<std::size_t> rock_on_the_way() const {
    for (std::size_t i = 0; i < ground_.hidden_rocks.size(); ++i) {
      const Rock& rock = ground_.hidden_rocks[i];
      const double touch = rock.radius + p_.radius_m;
      if (terrain::distance(here(), {rock.x, rock.y}) > touch + p_.rock_sight_m) continue;
      terrain::Point a = here();
      for (std::size_t leg = now_.next_waypoint; leg < way_.size(); a = way_[leg], ++leg) {
        if (distance_to_segment({rock.x, rock.y}, a, way_[leg]) < touch) return i;
      }
    }
    return std::nullopt;
  }

  // Returns whether way-points come closer, or the rover turns towards the next one.
  bool made_progress() {
    const double distance = terrain::distance(here(), way_[now_.next_waypoint]);
    if (distance < best_distance_ - kProgressMetres) {
      best_distance_ = distance;
      waited_s_ = 0;
    }
    return waited_s_ <= kPatienceSeconds;
  }

  // Returns the seconds that passed, less than a step only on arrival.
  double step() {
    const terrain::Point target = way_[now_.next_waypoint];
    const double error =
        wrapped(std::atan2(target.y - now_.pose.y, target.x - now_.pose.x) - now_.pose.heading);
    const double turn = p_.turn_rate_rad_s * kStepSeconds;
    waited_s_ += kStepSeconds;
    if (std::abs(error) > kTurnInPlaceRad) {
      now_.pose.heading = wrapped(now_.pose.heading + std::copysign(std::min(turn, std::abs(error)), error));
      use_power(p_.turn_power_w, kStepSeconds);
      return kStepSeconds;
    }
    const double drift = p_.heading_noise * std::sqrt(kStepSeconds) * noise_.normal();
    now_.pose.heading = wrapped(now_.pose.heading + std::clamp(error, -turn, turn) + drift);
    return roll(target);
  }

  double roll(terrain::Point target) {
    const terrain::Gradient gradient = ground_.site->gradient(here());
    const double slope = std::atan(std::hypot(gradient.east, gradient.north));
    const double pitch =
        std::atan(gradient.east * std::cos(now_.pose.heading) + gradient.north * std::sin(now_.pose.heading));
    const double wheel = wheel_speed(slope);
    const Footing soil = footing_on_soil(pitch, slope);
    const double speed = wheel * (1 - slip(pitch)) * (1 - soil.slip);
    if (!soil.bears) {
      spun_s_ += kStepSeconds;
      use_power(p_.drive_electronics_w + soil.resistance_n * wheel / p_.drive_efficiency, kStepSeconds);
      return kStepSeconds;
    }
    const double distance = terrain::distance(here(), target);
    const bool last = now_.next_waypoint + 1 == way_.size();
    const bool arrives = last && distance <= speed * kStepSeconds;
    const double dt = arrives ? distance / speed : kStepSeconds;
    if (arrives) {
      now_.pose.x = target.x;
      now_.pose.y = target.y;
    } else {
      now_.pose.x += speed * dt * std::cos(now_.pose.heading);
      now_.pose.y += speed * dt * std::sin(now_.pose.heading);
    }
    const double force =
        p_.weight_n * std::max(0.0, p_.rolling_resistance * std::cos(slope) + std::sin(pitch)) +
        soil.resistance_n;
    use_power(p_.drive_electronics_w + force * wheel / p_.drive_efficiency, dt);
    if (sensor_) no_go_ = sensor_->sense(ground_, now_.pose, std::abs(speed) * dt);
    return dt;
  }

  double wheel_speed(double slope) const {
    if (slope > p_.max_slope_deg * std::numbers::pi / 180) return 0;
    return p_.wheel_speed_m_s * std::max(0.1, 1 - p_.slope_slowdown * std::sin(slope));
  }

  // Returns the mean by pitch, times one plus a noise that remembers the last seconds (an Ornstein-Uhlenbeck
  // process).
  double slip(double pitch) {
    const double memory = std::exp(-kStepSeconds / kSlipMemorySeconds);
    slip_noise_ = memory * slip_noise_ + p_.slip_noise * std::sqrt(1 - memory * memory) * noise_.normal();
    const double uphill = std::max(0.0, std::sin(pitch));
    const double mean = p_.slip + p_.uphill_slip * uphill * uphill;
    return std::clamp(mean * (1 + slip_noise_), -0.05, kMaxSlip);
  }

  // Firm ground bears everything, and so does every ground of a body of which no wheels are known.
  Footing footing_on_soil(double pitch, double slope) {
    if (p_.wheels <= 0 || ground_.surface.soil.areas.empty()) return {};
    const world::Soil* soil = world::soil_at(ground_.surface.soil, here());
    if (!soil) return {};
    const Footing out = footing(*soil, vehicle_of(p_), pitch, slope);
    deepest_sinkage_m_ = std::max(deepest_sinkage_m_, out.sinkage_m);
    most_soil_slip_ = std::max(most_soil_slip_, out.slip);
    return out;
  }

  void use_power(double watts, double dt) {
    power_w_ = watts;
    now_.energy_j += watts * dt;
  }

  const Ground& ground_;
  const DriveParameters& p_;
  const std::vector<terrain::Point>& way_;
  RandomStream& noise_;
  SoilSensor* sensor_;
  std::optional<NoGo> no_go_;
  DriveSample now_;
  bool started_in_rock_ = false;
  double slip_noise_ = 0;
  double power_w_ = 0;
  double best_distance_ = INFINITY;
  double waited_s_ = 0;
  double spun_s_ = 0;
  double deepest_sinkage_m_ = 0;
  double most_soil_slip_ = 0;
};

}  // namespace

DriveSample DriveTrace::at(Time t) const {
  if (t <= start) return samples.front();
  if (t >= end) return samples.back();
  const auto before = static_cast<std::size_t>((t - start) / kDriveStep);
  const DriveSample& a = samples[before];
  const DriveSample& b = samples[before + 1];
  const Time a_time = start + static_cast<std::int64_t>(before) * kDriveStep;
  const Time b_time = std::min(a_time + kDriveStep, end);
  const double share = to_seconds(t - a_time) / to_seconds(b_time - a_time);
  DriveSample out = a;
  out.pose.x += share * (b.pose.x - a.pose.x);
  out.pose.y += share * (b.pose.y - a.pose.y);
  out.pose.heading = wrapped(a.pose.heading + share * wrapped(b.pose.heading - a.pose.heading));
  out.energy_j += share * (b.energy_j - a.energy_j);
  return out;
}

DriveTrace simulate_drive(const Ground& ground, const DriveParameters& parameters, Time start,
                          const Pose& from, const std::vector<terrain::Point>& way, std::size_t first,
                          RandomStream& noise, SoilSensor* sensor) {
  return DriveIntegration(ground, parameters, from, way, first, noise, sensor).run(start);
}

DriveTrace simulate_turn(const DriveParameters& p, Time start, const Pose& from, terrain::Point towards,
                         RandomStream& noise) {
  const double wanted = std::atan2(towards.y - from.y, towards.x - from.x);
  const double rest = here_is(from, towards) ? 0 : wrapped(wanted - from.heading);
  const double lasts = std::abs(rest) / p.turn_rate_rad_s;
  const double drift = p.heading_noise * std::sqrt(lasts) * noise.normal();
  DriveTrace trace;
  trace.start = start;
  trace.end = start + seconds(lasts);
  trace.peak_power_w = p.turn_power_w;
  const auto steps = static_cast<std::int64_t>(std::ceil(lasts / kStepSeconds));
  for (std::int64_t i = 0; i <= steps; ++i) {
    const double share = lasts > 0 ? std::min(1.0, static_cast<double>(i) * kStepSeconds / lasts) : 1.0;
    DriveSample sample{from, p.turn_power_w * share * lasts};
    sample.pose.heading = wrapped(from.heading + share * (rest + drift));
    trace.samples.push_back(sample);
  }
  return trace;
}

}  // namespace roci::sim::components
