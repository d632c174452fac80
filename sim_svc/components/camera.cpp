#include "sim_svc/components/camera.hpp"

#include <algorithm>
#include <utility>

#include "sim_svc/components/preview.hpp"

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Image;
using world::Surroundings;

Camera::Camera(CameraSettings settings, world::RandomStream noise)
    : settings_(settings), noise_(std::move(noise)) {}

State Camera::state() const { return busy() ? State{"imaging", {}} : State{"idle", {}}; }

Ending Camera::forbids_driving() const {
  if (!busy()) return std::nullopt;
  return Failure{"camera-busy", "the camera is taking an image; wait for it"};
}

Ending Camera::begin(const world::Task& task, Time now, Surroundings& around) {
  const auto* wheels = around.components.find<world::Mobility>();
  if (wheels && !wheels->place()) {
    return Failure{"driving", "the robot drives and the image would be blurred; stop it first"};
  }
  const double duration =
      settings_.duration_s * std::max(0.5, 1 + settings_.duration_noise * noise_.normal());
  shot_ = Shot{task.arguments.at("image"), task.key.activity, now + temporal::seconds(duration)};
  return std::nullopt;
}

std::optional<Time> Camera::next_change() const {
  if (!shot_) return std::nullopt;
  return shot_->end;
}

Ending Camera::finish(Surroundings& around) {
  const double bytes = settings_.image_bytes * std::max(0.1, 1 + settings_.bytes_noise * noise_.normal());
  const world::Pose& pose = *around.body.pose;
  Image image{shot_->image,  around.robot,
              shot_->source, static_cast<std::uint64_t>(bytes),
              false,         shot_->end,
              pose,          render_preview(around.environment.ground, pose, settings_.image_noise, noise_)};
  last_bytes_ = static_cast<double>(image.bytes);
  around.deeds.push_back({"image", image.id});
  around.out.push_back(image);
  around.body.images.insert_or_assign(image.id, std::move(image));
  shot_.reset();
  return std::nullopt;
}

double Camera::energy_j(Time from, Time to) const {
  return busy() ? settings_.power_w * temporal::to_seconds(to - from) : 0;
}

}  // namespace roci::sim::components
