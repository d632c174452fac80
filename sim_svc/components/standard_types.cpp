// This file has the names and ranges of the settings of each type; their defaults stand with the types.
#include "sim_svc/components/standard_types.hpp"

#include <memory>
#include <utility>

#include "core/mission/bounded_number.hpp"
#include "sim_svc/components/arm.hpp"
#include "sim_svc/components/arm_settings.hpp"
#include "sim_svc/components/camera.hpp"
#include "sim_svc/components/direct_radio_settings.hpp"
#include "sim_svc/components/drive_settings.hpp"
#include "sim_svc/components/dynamic_arm.hpp"
#include "sim_svc/components/dynamic_arm_settings.hpp"
#include "sim_svc/components/grapple.hpp"
#include "sim_svc/components/grapple_settings.hpp"
#include "sim_svc/components/gripper.hpp"
#include "sim_svc/components/laboratory.hpp"
#include "sim_svc/components/laboratory_settings.hpp"
#include "sim_svc/components/marker_camera.hpp"
#include "sim_svc/components/radio.hpp"
#include "sim_svc/components/sampling_arm.hpp"
#include "sim_svc/components/sampling_arm_settings.hpp"
#include "sim_svc/components/seismometer_settings.hpp"
#include "sim_svc/components/survey_camera_settings.hpp"
#include "sim_svc/components/task.hpp"
#include "sim_svc/components/task_settings.hpp"

namespace roci::sim::components {

using setup::ComponentType;
using setup::Settings;

namespace {

template <class Component, class ComponentSettings>
world::MakeComponent making(ComponentSettings settings) {
  return [settings = std::move(settings)](world::RandomStream noise) {
    return std::make_unique<Component>(settings, std::move(noise));
  };
}

world::MakeComponent read_drive(Settings& in) { return making<Drive>(read_drive_settings(in)); }

world::MakeComponent read_arm(Settings& in) { return making<Arm>(read_arm_settings(in)); }

double between(Settings& in, std::string_view key, double fallback, double least, double most) {
  return mission::bounded_number(in.find(key), key, fallback, least, most);
}

world::MakeComponent read_camera(Settings& in) {
  CameraSettings out;
  out.duration_s = in.number("duration_s", out.duration_s);
  out.duration_noise = in.number("duration_noise", out.duration_noise);
  out.power_w = in.number("power_w", out.power_w);
  out.image_bytes = in.number("image_bytes", out.image_bytes);
  out.bytes_noise = in.number("bytes_noise", out.bytes_noise);
  View& view = out.view;
  view.noise = in.number("image_noise", view.noise);
  view.mast_m = between(in, "mast_m", view.mast_m, 0.1, 20);
  view.tilt_deg = between(in, "tilt_deg", view.tilt_deg, -30, 80);
  view.view_deg = between(in, "view_deg", view.view_deg, 5, 150);
  view.width_px = static_cast<int>(between(in, "width_px", view.width_px, 8, 1024));
  view.height_px = static_cast<int>(between(in, "height_px", view.height_px, 8, 1024));
  if (const auto every = in.find("panorama_every_s")) {
    out.panorama_every_s = every->number();
    if (out.panorama_every_s != 0 && (out.panorama_every_s < 1 || out.panorama_every_s > 1e9))
      every->fail("'panorama_every_s' must be at least 1, or 0 for none; correct the number");
  }
  out.panorama_views = static_cast<int>(between(in, "panorama_views", out.panorama_views, 1, kMostViews));
  return making<Camera>(out);
}

world::MakeComponent read_marker_camera(Settings& in) {
  MarkerCameraSettings out;
  out.duration_s = in.number("duration_s", out.duration_s);
  out.power_w = in.number("power_w", out.power_w);
  out.mast_m = between(in, "mast_m", out.mast_m, 0.1, 20);
  out.marker_m = between(in, "marker_m", out.marker_m, 0.01, 20);
  out.least_range_m = between(in, "least_range_m", out.least_range_m, 0.01, 100);
  out.most_range_m = between(in, "most_range_m", out.most_range_m, out.least_range_m, 100);
  out.view_deg = between(in, "view_deg", out.view_deg, 5, 360);
  out.miss_share = in.share("miss_share", out.miss_share);
  out.range_noise = in.number("range_noise", out.range_noise);
  out.heading_noise_rad = in.number("heading_noise_rad", out.heading_noise_rad);
  out.light = in.text("light", out.light);
  return making<MarkerCamera>(out);
}

world::MakeComponent read_gripper(Settings& in) {
  GripperSettings out;
  out.pick_s = in.number("pick_s", out.pick_s);
  out.drop_s = in.number("drop_s", out.drop_s);
  out.duration_noise = in.number("duration_noise", out.duration_noise);
  out.power_w = in.number("power_w", out.power_w);
  out.pick_pose = in.text("pick_pose", out.pick_pose);
  out.drop_pose = in.text("drop_pose", out.drop_pose);
  return making<Gripper>(std::move(out));
}

world::MakeComponent read_radio(Settings& in) {
  RadioSettings out;
  out.rate_bit_s = in.number("rate_bit_s", out.rate_bit_s, 1);
  out.rate_noise = in.number("rate_noise", out.rate_noise);
  out.power_w = in.number("power_w", out.power_w);
  out.window = in.text("window", out.window);
  return making<Radio>(std::move(out));
}

}  // namespace

setup::Registry standard_types() {
  setup::Registry out;
  out.add("drive", {read_drive, true});
  out.add("arm", {read_arm});
  out.add("dynamic_arm", {[](Settings& in) { return making<DynamicArm>(read_dynamic_arm_settings(in)); }});
  out.add("grapple", {[](Settings& in) { return making<Grapple>(read_grapple_settings(in)); }});
  out.add("camera", {read_camera, true});
  out.add("marker_camera", {read_marker_camera, true});
  out.add("gripper", {read_gripper});
  out.add("radio", {read_radio});
  out.add("sampling_arm", {[](Settings& in) { return making<SamplingArm>(read_sampling_arm_settings(in)); },
                           false, true, true});
  out.add("laboratory",
          {[](Settings& in) { return making<Laboratory>(read_laboratory_settings(in)); }, false, true, true});
  out.add("task",
          {[](Settings& in) { return making<TaskComponent>(read_task_settings(in)); }, false, true, true});
  ComponentType radio{[](Settings& in) { return making<DirectRadio>(read_direct_radio_settings(in)); }};
  radio.can_be_hollow = radio.has_rate = true;
  out.add("direct_radio", radio);
  out.add("survey_camera",
          {[](Settings& in) { return making<SurveyCamera>(read_survey_camera_settings(in)); }, false, true,
           true});
  out.add("seismometer", {[](Settings& in) { return making<Seismometer>(read_seismometer_settings(in)); },
                          false, true, true});
  return out;
}

}  // namespace roci::sim::components
