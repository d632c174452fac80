#include "sim_svc/components/drive.hpp"

#include <charconv>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include "core/terrain/way.hpp"

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Surroundings;

namespace {

constexpr double kRim = 0.05;  // m, of a marked circle in which a No-Go is no news either

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// Says where a command leads: over points that it brings, or to one.
struct Wanted {
  terrain::Way way;
  bool given = false;
  std::string fault{};  // empty: it leads there
};

Wanted wanted_of(const world::Task& task, const world::Ground& ground) {
  const auto text = task.arguments.find("way");
  if (task.command != "drive" || text == task.arguments.end()) {
    const auto x = number(task.arguments.at("x")), y = number(task.arguments.at("y"));
    if (!x || !y) return {{}, false, "x and y must be numbers, in metres"};
    return {{{*x, *y}}};
  }
  auto [way, fault] = terrain::read_way(text->second, kGivenPoints);
  if (!fault.empty()) return {{}, true, "way: " + fault};
  for (std::size_t i = 0; i < way.size(); ++i)
    if (!ground.site->grid().contains(way[i]))
      return {
          {},
          true,
          "way: point " + std::to_string(i + 1) + " (" + terrain::to_text({way[i]}) + ") lies off the map"};
  return {std::move(way), true};
}

Failure bogged_down() {
  return {"bogged-down",
          "the soil does not bear the robot, and its wheels have dug it in; it needs help from outside"};
}

}  // namespace

Drive::Drive(DriveSettings settings, world::RandomStream noise)
    : settings_(std::move(settings)),
      place_(settings_.stop_place),
      noise_(std::move(noise)),
      soil_noise_(noise_.branch("soil")) {}

State Drive::state() const {
  if (!target_) return State{"idle-at", {place_}};
  return State{"going-to", {target_->turns ? place_ : target_->place}};
}

std::optional<std::string> Drive::place() const {
  if (target_) return std::nullopt;
  return place_;
}

world::Memory Drive::memory() const {
  const bool moved = target_ && !target_->turns && (trace_ || detours_ > 0);
  world::Memory out{{"place", State{"idle-at", {moved ? settings_.stop_place : place_}}}};
  if (bogged_) out.emplace("bogged", true);
  return out;
}

void Drive::restore(const world::Memory& memory) {
  const auto kept = memory.find("place");
  const auto* state = kept == memory.end() ? nullptr : std::get_if<State>(&kept->second);
  if (state && state->arguments.size() == 1) place_ = state->arguments.front();
  const auto bogged = memory.find("bogged");
  bogged_ = bogged != memory.end() && bogged->second == temporal::Value{true};
}

Ending Drive::begin(const world::Task& task, Time now, Surroundings& around) {
  const Wanted wanted = wanted_of(task, around.environment.ground);
  if (!wanted.fault.empty()) return Failure{"bad-arguments", task.command + ": " + wanted.fault};
  if (bogged_) return bogged_down();
  for (const auto* other : around.components.all<world::BodyInterlock>()) {
    if (Ending forbidden = other->forbids_driving()) return forbidden;
  }
  detours_ = last_detours_ = 0;
  sinkage_m_ = soil_slip_ = 0;
  soil_ = {};
  const auto [x, y] = wanted.way.back();
  if (task.command == "turn") {
    target_ = Target{task.key, task.latest_end, place_, x, y, true};
    trace_ = simulate_turn(settings_.motion, now, *around.body.pose, {x, y}, noise_);
    around.effects.push_back({"turn", place_});
    return std::nullopt;
  }
  target_ = Target{task.key, task.latest_end, task.arguments.at("to"), x, y, false, wanted.given};
  if (!wanted.given) {
    ask(around);
    return std::nullopt;
  }
  way_ = wanted.way;
  around.effects.push_back({"motion", target_->place});
  simulate(now, *around.body.pose, 0, around.environment.ground);
  return std::nullopt;
}

void Drive::ask(Surroundings& around) const {
  around.out.push_back(world::PathWanted{target_->key, settings_.planner, around.robot, *around.body.pose,
                                         target_->x, target_->y});
}

Ending Drive::answer(const world::Answer& answer, Time now, Surroundings& around) {
  const auto* way = std::get_if<world::Way>(&answer);
  if (!way || way->points.empty()) return Failure{"no-path", "the path has no way-points"};
  way_ = way->points;
  around.effects.push_back({detours_ == 0 ? "motion" : "detour", target_->place});
  simulate(now, *around.body.pose, 0, around.environment.ground);
  return std::nullopt;
}

void Drive::ground_changed(Time now, Surroundings& around) {
  if (!trace_ || target_->turns) return;
  const DriveSample sample = trace_->at(now);
  around.body.pose = sample.pose;
  simulate(now, sample.pose, sample.next_waypoint, around.environment.ground);
}

void Drive::simulate(Time now, const world::Pose& from, std::size_t first, const world::Ground& ground) {
  SoilSensor sensor(settings_.soil_sensor, marked_, soil_noise_);
  const bool senses = !settings_.soil_sensor.instruments.empty();
  trace_ =
      simulate_drive(ground, settings_.motion, now, from, way_, first, noise_, senses ? &sensor : nullptr);
}

std::optional<Time> Drive::next_change() const {
  if (trace_) return trace_->end;
  return looks_until_;
}

Ending Drive::finish(Surroundings& around) {
  if (looks_until_) {
    looks_until_.reset();
    ask(around);
    return std::nullopt;
  }
  const DriveTrace trace = *std::exchange(trace_, std::nullopt);
  around.body.pose = trace.samples.back().pose;
  const std::string rock = trace.outcome == DriveEnd::blocked ? see_rock(trace, around) : "";
  if (!rock.empty() && looks_around(trace, rock, around)) return std::nullopt;
  bogged_ = trace.outcome == DriveEnd::bogged;
  sinkage_m_ = trace.deepest_sinkage_m;
  soil_slip_ = trace.most_soil_slip;
  soil_ = trace.soil;
  stand(trace.outcome == DriveEnd::arrived ? target_->place : settings_.stop_place);
  switch (trace.outcome) {
    case DriveEnd::arrived:
      return std::nullopt;
    case DriveEnd::stuck:
      return Failure{"stuck", "the wheels turn without progress"};
    case DriveEnd::collision:
      return Failure{"collision", "the path led into a rock of the map"};
    case DriveEnd::no_go:
      return mark_soil(trace, around);
    case DriveEnd::bogged:
      return bogged_down();
    case DriveEnd::blocked:
      break;
  }
  return Failure{"blocked", "a rock that the map does not show lies on the way (" + rock + ")"};
}

// Returns whether the drive repairs what stopped it: it looks at the rock and will ask for a way around. A way that was
// given is somebody else's.
bool Drive::looks_around(const DriveTrace& trace, const std::string& rock, Surroundings& around) {
  const Time looked = trace.end + temporal::seconds(settings_.look_s);
  if (target_->given || detours_ >= settings_.detours ||
      (target_->latest_end && looked >= *target_->latest_end))
    return false;
  ++detours_;
  looks_until_ = looked;
  around.out.push_back(world::TaskReport{target_->key, world::TaskStage::repairing, "repairing",
                                         rock + " lies on the way and on no map; it looks for a way around",
                                         trace.end});
  return true;
}

// Returns the id under which the rock that ended the trace is known from now on.
std::string Drive::see_rock(const DriveTrace& trace, Surroundings& around) {
  const std::size_t index = *trace.seen_rock;
  auto& known = around.environment.known_rocks;
  const std::string id = known.try_emplace(index, "rock-" + std::to_string(known.size() + 1)).first->second;
  if (seen_rocks_.insert(index).second) {
    const world::Rock& rock = around.environment.ground.hidden_rocks[index];
    around.out.push_back(
        world::RockSeen{id, around.robot, rock.x, rock.y, rock.radius, trace.end, settings_.own_map});
  }
  return id;
}

std::map<std::string, temporal::Value> Drive::results() const {
  std::map<std::string, temporal::Value> out{{"detours", last_detours_}};
  if (settings_.motion.wheels <= 0) return out;
  out.emplace("sinkage", sinkage_m_);
  out.emplace("soil_slip", soil_slip_);
  if (settings_.soil_sensor.instruments.empty()) return out;
  out.emplace("soil_samples", static_cast<double>(soil_.samples));
  out.emplace("soil_margin", soil_.least_margin);
  return out;
}

// Marks a circle that begins at the place that was measured and lies ahead of the body, so that it stands outside;
// returns what the drive ends with.
Failure Drive::mark_soil(const DriveTrace& trace, Surroundings& around) {
  const SoilSensorSettings& sensor = settings_.soil_sensor;
  const NoGo& no_go = *trace.no_go;
  const double heading = trace.samples.back().pose.heading;
  const terrain::Point centre{no_go.at.x + sensor.mark_radius_m * std::cos(heading),
                              no_go.at.y + sensor.mark_radius_m * std::sin(heading)};
  marked_.push_back({centre, sensor.mark_radius_m + kRim});
  const std::string id = around.robot + "-soil-" + std::to_string(marked_.size());
  around.out.push_back(world::SoilMarked{id, around.robot, no_go.instrument, sensor.judges_for, centre.x,
                                         centre.y, sensor.mark_radius_m, trace.end, settings_.own_map});
  std::ostringstream why;
  why << std::fixed << std::setprecision(2) << "the " << no_go.instrument << " says No-Go for "
      << sensor.judges_for << ": it would sink " << no_go.expected.sinkage_m << " m and need "
      << no_go.expected.traction_share << " of the thrust that the soil gives; " << id << " marks the place";
  return {"no-go", why.str()};
}

void Drive::halt(Time now, Surroundings& around) {
  const bool moved = target_ && !target_->turns && (trace_.has_value() || detours_ > 0);
  settle(now, around.body);
  stand(moved ? settings_.stop_place : place_);
}

void Drive::settle(Time now, world::Body& body) {
  if (trace_) body.pose = trace_->at(now).pose;
}

double Drive::energy_j(Time from, Time to) const {
  return trace_ ? trace_->at(to).energy_j - trace_->at(from).energy_j : 0;
}

void Drive::stand(std::string place) {
  place_ = std::move(place);
  target_.reset();
  trace_.reset();
  looks_until_.reset();
  last_detours_ = std::exchange(detours_, 0);
}

}  // namespace roci::sim::components
