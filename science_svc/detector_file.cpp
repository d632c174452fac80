#include "science_svc/detector_file.hpp"

namespace roci::science {
namespace {

using mission::Entry;

double within(const Entry& section, std::string_view key, double fallback, double least, double most) {
  const auto entry = section.find(key);
  if (!entry) return fallback;
  const double value = entry->number();
  if (value < least || value > most) {
    entry->fail("'" + std::string(key) + "' must lie between " + std::to_string(least) + " and " +
                std::to_string(most) + "; correct the number");
  }
  return value;
}

}  // namespace

DetectorSettings read_detector(const Entry& mission, const Entry& scenario) {
  DetectorSettings out;
  const auto section = mission.find("science");
  out.enabled = section.has_value();
  if (section) {
    section->allow_only({"threshold", "goal_kind", "offset_m", "min_interval_s", "merge_m", "limit"});
    out.threshold = within(*section, "threshold", out.threshold, 0, 1);
    out.goal_kind = section->text_or("goal_kind", out.goal_kind);
    out.offset_m = within(*section, "offset_m", out.offset_m, 0, 1000);
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
