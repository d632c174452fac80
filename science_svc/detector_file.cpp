#include "science_svc/detector_file.hpp"

#include "core/mission/bounded_number.hpp"

namespace roci::science {
namespace {

using mission::Entry;

double within(const Entry& section, std::string_view key, double fallback, double least, double most) {
  return mission::bounded_number(section.find(key), key, fallback, least, most);
}

void read_camera(const Entry& section, CameraModel& out) {
  section.allow_only({"mast_m", "tilt_deg", "view_deg"});
  out.mast_m = within(section, "mast_m", out.mast_m, 0.1, 20);
  out.tilt_deg = within(section, "tilt_deg", out.tilt_deg, -30, 80);
  out.view_deg = within(section, "view_deg", out.view_deg, 5, 150);
}

}  // namespace

DetectorSettings read_detector(const Entry& mission, const Entry& scenario) {
  DetectorSettings out;
  const auto section = mission.find("science");
  out.enabled = section.has_value();
  if (section) {
    section->allow_only(
        {"threshold", "goal_kind", "offset_m", "reach_m", "min_interval_s", "merge_m", "limit", "camera"});
    out.threshold = within(*section, "threshold", out.threshold, 0, 1);
    out.goal_kind = section->text_or("goal_kind", out.goal_kind);
    if (const auto offset = section->find("offset_m")) {
      out.warnings.push_back(
          offset->place() +
          ": warning: 'offset_m' has no effect any more, since a find lies where the image " +
          "shows it (drop it)");
    }
    out.reach_m = within(*section, "reach_m", out.reach_m, 1, 100);
    if (const auto camera = section->find("camera")) read_camera(*camera, out.camera);
    out.min_interval = temporal::seconds(within(*section, "min_interval_s", 0, 0, 1e9));
    out.merge_m = within(*section, "merge_m", out.merge_m, 0, 1000);
    out.limit = static_cast<int>(within(*section, "limit", out.limit, 0, 1000));
  }
  if (const auto override = scenario.find("science")) {
    override->allow_only({"enabled", "threshold", "limit"});
    out.enabled = out.enabled && override->truth_or("enabled", true);
    out.threshold = within(*override, "threshold", out.threshold, 0, 1);
    out.limit = static_cast<int>(within(*override, "limit", out.limit, 0, 1000));
  }
  return out;
}

}  // namespace roci::science
