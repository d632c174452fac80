#include "sim_svc/components/survey_camera_settings.hpp"

#include <algorithm>

namespace roci::sim::components {

namespace {

using mission::Entry;

void read_survey(const Entry& entry, Survey& out) {
  entry.allow_only({"duration_s", "power_w", "heat_w"});
  out.duration_s = setup::number(entry, "duration_s", out.duration_s);
  out.power_w = setup::number(entry, "power_w", out.power_w);
  out.heat_w = setup::number(entry, "heat_w", std::min(out.heat_w, out.power_w));
  if (out.heat_w > out.power_w)
    entry.fail("a camera leaves no more heat than it draws; lower heat_w, or raise power_w");
}

// Reads what things are worth, by their names.
void read_worths(const Entry& entry, std::map<std::string, double>& out) {
  entry.each_field([&](const std::string& name, const Entry& value) { out[name] = value.number(); });
}

}  // namespace

SurveyCameraSettings read_survey_camera_settings(setup::Settings& in) {
  SurveyCameraSettings out;
  out.zone = in.text("zone", out.zone);
  for (auto& [command, survey] : out.surveys)
    if (const auto entry = in.find(command)) read_survey(*entry, survey);
  out.duration_noise = in.share("duration_noise", out.duration_noise);
  out.duration_factor = in.number("duration_factor", out.duration_factor, 1e-3);
  out.power_noise = in.share("power_noise", out.power_noise);
  if (const auto values = in.find("values")) read_worths(*values, out.values);
  if (const auto visual = in.find("visual")) read_worths(*visual, out.visual);
  out.products = read_products_by_command(in, SurveyCamera::forms());
  return out;
}

}  // namespace roci::sim::components
