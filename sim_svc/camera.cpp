#include "sim_svc/camera.hpp"

#include <algorithm>

#include "sim_svc/preview.hpp"

namespace roci::sim {

Camera::Camera(std::uint64_t seed) : noise_(seed, "camera") {}

Ending Camera::begin(const Task& task, Time now, Surroundings& around) {
  if (around.view.nav.name != "idle-at") {
    return Failure{"driving", "the rover drives and the image would be blurred; stop it first"};
  }
  const CameraParameters& camera = around.robot.camera;
  const double duration = camera.duration_s * std::max(0.5, 1 + camera.duration_noise * noise_.normal());
  shot_ = Shot{task.arguments.at("image"), task.key.activity, now + seconds(duration)};
  power_w_ = camera.power_w;
  return std::nullopt;
}

std::optional<Time> Camera::next_change() const {
  if (!shot_) return std::nullopt;
  return shot_->end;
}

Ending Camera::finish(Surroundings& around) {
  const CameraParameters& camera = around.robot.camera;
  const double bytes = camera.image_bytes * std::max(0.1, 1 + camera.bytes_noise * noise_.normal());
  Image image{shot_->image,
              shot_->source,
              static_cast<std::uint64_t>(bytes),
              false,
              shot_->end,
              around.view.pose,
              render_preview(around.ground, around.view.pose, camera.image_noise, noise_)};
  around.out.push_back(image);
  around.images.insert_or_assign(image.id, std::move(image));
  shot_.reset();
  return std::nullopt;
}

}  // namespace roci::sim
