#include "sim_svc/components/marker_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim_svc/components/relief.hpp"

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Pose;
using world::Surroundings;

namespace {

constexpr double kRayStep = 0.1;  // m
constexpr double kBodyEnd = 0.3;  // m at the marker's end of the ray that its own body takes

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

std::string why_unseen(const world::Ground& ground, const MarkerCameraSettings& settings, const Pose& from,
                       const Pose& to) {
  const double range = terrain::distance({from.x, from.y}, {to.x, to.y});
  if (range < settings.least_range_m) return "it is nearer than the camera can focus";
  if (range > settings.most_range_m) return "it is farther than the camera can resolve";
  const double bearing = wrapped(std::atan2(to.y - from.y, to.x - from.x) - from.heading);
  if (std::abs(bearing) > settings.view_deg / 2 * std::numbers::pi / 180)
    return "it is outside the field of view";
  const terrain::Point middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
  const Relief relief(ground, middle, range / 2 + 1);
  const double eye = relief.floor({from.x, from.y}) + settings.mast_m;
  const double marker = relief.floor({to.x, to.y}) + settings.marker_m;
  for (double way = kRayStep; way < range - kBodyEnd; way += kRayStep) {
    const double share = way / range;
    const terrain::Point p{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    if (relief.height(p) > eye + share * (marker - eye)) return "the ground or a rock hides it";
  }
  return "";
}

MarkerCamera::MarkerCamera(const MarkerCameraSettings& settings, world::RandomStream noise)
    : settings_(settings), noise_(std::move(noise)) {}

State MarkerCamera::state() const { return busy() ? State{"looking", {}} : State{"idle", {}}; }

std::vector<std::string> MarkerCamera::awaited_windows() const {
  if (settings_.light.empty()) return {};
  return {settings_.light};
}

Ending MarkerCamera::forbids_driving() const {
  if (!busy()) return std::nullopt;
  return Failure{"camera-busy", "the camera is looking for a marker; wait for it"};
}

Ending MarkerCamera::begin(const world::Task& task, Time now, Surroundings& around) {
  const std::string& robot = task.arguments.at("robot");
  if (robot == around.robot || !around.environment.poses.contains(robot))
    return Failure{"unknown-robot", "no other robot '" + robot + "' stands on the map; name one that does"};
  const auto* wheels = around.components.find<world::Mobility>();
  if (wheels && !wheels->place())
    return Failure{"driving", "the robot drives and the image would be blurred; stop it first"};
  results_.clear();
  look_ = Look{robot, now + temporal::seconds(settings_.duration_s)};
  if (!settings_.light.empty()) {
    const auto& windows = around.environment.windows;
    const auto light = std::ranges::find(windows, settings_.light, &world::Window::timeline);
    look_->dark = light == windows.end() || !light->is_open(now);
  }
  return std::nullopt;
}

std::optional<Time> MarkerCamera::next_change() const {
  if (!look_) return std::nullopt;
  return look_->end;
}

// The noise is drawn whether the marker is seen or not, so that one look does not depend on how an earlier one ended.
Ending MarkerCamera::finish(Surroundings& around) {
  const Look look = *std::exchange(look_, std::nullopt);
  const Pose& here = *around.body.pose;
  const Pose& there = around.environment.poses.at(look.robot);
  const bool missed = noise_.uniform() < settings_.miss_share;
  const double east = noise_.normal(), north = noise_.normal(), turn = noise_.normal();
  std::string why = why_unseen(around.environment.ground, settings_, here, there);
  if (why.empty() && look.dark) why = settings_.light + " is closed";
  if (why.empty() && missed) why = "it was not found in the image";
  if (!why.empty()) return Failure{"marker-not-seen", "the marker of " + look.robot + " is not seen: " + why};
  const double spread = settings_.range_noise * terrain::distance({here.x, here.y}, {there.x, there.y});
  results_ = {{"x", there.x + spread * east},
              {"y", there.y + spread * north},
              {"heading", wrapped(there.heading + settings_.heading_noise_rad * turn)}};
  return std::nullopt;
}

double MarkerCamera::energy_j(Time from, Time to) const {
  return busy() ? settings_.power_w * temporal::to_seconds(to - from) : 0;
}

}  // namespace roci::sim::components
