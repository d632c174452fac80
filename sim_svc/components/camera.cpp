#include "sim_svc/components/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Image;
using world::Surroundings;

namespace {

// So many numbers an earlier camera drew for the pixels of each image from the stream that durations and sizes come
// from. They are still passed over, so that a seed goes on giving the same durations.
constexpr int kFormerDraws = 24 * 16;

}  // namespace

Camera::Camera(CameraSettings settings, world::RandomStream noise)
    : settings_(settings),
      panorama_due_(temporal::seconds(settings.panorama_every_s)),
      noise_(std::move(noise)),
      pixels_(noise_.branch("pixels")) {}

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
  const std::string& id = task.arguments.at("image");
  if (!around.body.images.has_room_for(id)) {
    return Failure{"data-full", "there is no room on board for image '" + id + "'; send others first"};
  }
  const double duration = settings_.duration_s * noise_.factor(settings_.duration_noise);
  shot_ = Shot{id, task.key.activity, now + temporal::seconds(duration)};
  return std::nullopt;
}

std::optional<Time> Camera::next_change() const {
  if (!shot_) return std::nullopt;
  return shot_->end;
}

Ending Camera::finish(Surroundings& around) {
  const double bytes = settings_.image_bytes * std::max(0.1, 1 + settings_.bytes_noise * noise_.normal());
  for (int i = 0; i < kFormerDraws; ++i) noise_.normal();
  Image image = picture(shot_->image, *around.body.pose, shot_->end, around);
  image.source = shot_->source;
  image.bytes = static_cast<std::uint64_t>(bytes);
  last_bytes_ = static_cast<double>(image.bytes);
  around.effects.push_back({"image", image.id});
  around.out.push_back(image);
  around.body.images.add(std::move(image));
  shot_.reset();
  return std::nullopt;
}

// The pixels' noise belongs to the image, whatever was taken before.
Image Camera::picture(const std::string& id, const world::Pose& pose, Time at,
                      const Surroundings& around) const {
  Image image;
  image.id = id;
  image.robot = around.robot;
  image.taken = at;
  image.taken_from = pose;
  image.preview = render_preview(around.environment.ground, pose, settings_.view, at, pixels_.branch(id));
  return image;
}

std::optional<Time> Camera::next_routine() const {
  if (settings_.panorama_every_s <= 0 || panorama_waits_) return std::nullopt;
  return panorama_due_;
}

void Camera::run_routine(Time now, bool able, Surroundings& around) {
  if (settings_.panorama_every_s <= 0 || now < panorama_due_) return;
  const auto* wheels = around.components.find<world::Mobility>();
  panorama_waits_ = able && (busy() || (wheels && !wheels->place()));  // the end of either is an event
  if (panorama_waits_) return;
  if (able) take_panorama(now, around);
  const temporal::Duration every = temporal::seconds(settings_.panorama_every_s);
  panorama_due_ = (now / every + 1) * every;
}

void Camera::take_panorama(Time now, Surroundings& around) {
  const std::string name = around.robot + "-panorama-" + std::to_string(now.count() / 1'000'000) + "-";
  for (int i = 0; i < settings_.panorama_views; ++i) {
    world::Pose pose = *around.body.pose;
    pose.heading = std::remainder(pose.heading + 2 * std::numbers::pi * i / settings_.panorama_views,
                                  2 * std::numbers::pi);
    Image view = picture(name + std::to_string(i + 1), pose, now, around);
    view.kind = "panorama";
    view.bytes = view.preview.size();
    around.out.push_back(std::move(view));
  }
}

double Camera::energy_j(Time from, Time to) const {
  return busy() ? settings_.power_w * temporal::to_seconds(to - from) : 0;
}

}  // namespace roci::sim::components
