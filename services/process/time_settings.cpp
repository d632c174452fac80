#include "services/process/time_settings.hpp"

#include "core/mission/service_list.hpp"

namespace roci::services::process {
namespace {

double positive_or(const mission::Entry& entry, const char* key, double fallback) {
  const double value = entry.number_or(key, fallback);
  if (value <= 0) entry.at(key).fail(std::string(key) + " must be more than 0");
  return value;
}

}  // namespace

TimeWatchSettings read_time_settings(const mission::Entry& mission) {
  TimeWatchSettings out;
  const auto entry = mission.find("clock");
  if (entry) {
    entry->allow_only({"reference", "offset_s", "drift_ppm", "period_s"});
    out.bounds.offset =
        temporal::seconds(positive_or(*entry, "offset_s", temporal::to_seconds(out.bounds.offset)));
    out.bounds.drift_ppm = positive_or(*entry, "drift_ppm", out.bounds.drift_ppm);
    out.period_s = positive_or(*entry, "period_s", out.period_s);
  }
  if (!mission.find("services")) {
    if (entry && entry->find("reference")) entry->fail("a reference needs services:; add the list");
    return out;
  }
  const mission::ServiceList list = mission::read_service_list(mission);
  if (const auto reference = entry ? entry->find("reference") : std::nullopt) {
    out.reference = reference->text();
    if (list.find(out.reference) == nullptr)
      reference->fail("no service '" + out.reference + "' stands in services:");
    return out;
  }
  const mission::ServiceEntry* master = list.clock_master();
  out.reference = master != nullptr ? master->name : list.services.front().name;
  return out;
}

}  // namespace roci::services::process
