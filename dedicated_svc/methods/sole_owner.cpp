#include "dedicated_svc/methods/sole_owner.hpp"

#include "core/mission/mission_file.hpp"
#include "core/mission/service_list.hpp"

namespace roci::dedicated::methods {
namespace {

constexpr char kProgram[] = "dedicated_svc";

// The settings of another executive may be faulty; that is for it to say.
std::string timeline_of(const std::filesystem::path& settings) try {
  return mission::load_mission_file(settings).at("dedicated").at("timeline").text();
} catch (const mission::FileError&) {
  return {};
}

}  // namespace

void check_sole_owner(const mission::Entry& dedicated, const std::filesystem::path& mission_folder,
                      const std::string& name) {
  if (!std::filesystem::exists(mission::mission_file(mission_folder))) return;
  const mission::Entry timeline = dedicated.at("timeline");
  const mission::Entry mission = mission::load_mission_file(mission_folder);
  if (const auto components = mission.find("components")) {
    for (const mission::Entry& component : components->items()) {
      if (component.text_or("timeline", "") != timeline.text()) continue;
      const std::string owner = component.text_or("owner", name);
      if (owner == name) return;  // another one that shows it is told so
      timeline.fail("'" + timeline.text() + "' belongs to " + owner + ", the owner of component '" +
                    component.text_or("name", "") + "' in mission.yaml; show another timeline, or make " +
                    name + " its owner");
    }
  }
  const mission::ServiceList list = mission::load_service_list_if_any(mission_folder);
  for (const mission::ServiceEntry* other : list.of_program(kProgram))
    if (other->name != name && timeline_of(other->settings) == timeline.text())
      timeline.fail("'" + timeline.text() + "' is shown by " + other->name + ", too (" +
                    other->settings.filename().string() +
                    "); a timeline has one owner: take one of them out of "
                    "`services:`");
}

}  // namespace roci::dedicated::methods
