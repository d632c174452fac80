#include "exec_svc/run_files_service.hpp"

#include "core/mission/mission_file.hpp"

namespace roci::exec {

using mission::ExecutiveRole;
using roci::mission::ServiceList;

ServiceList services_of(const services::RunSettings& settings) {
  const roci::mission::Entry mission = roci::mission::load_mission_file(settings.mission);
  return mission.find("services") ? roci::mission::read_service_list(mission) : ServiceList{};
}

ExecutiveRole role_of(const services::RunSettings& settings, const services::node::NodeOptions& node) {
  return mission::role_of(services_of(settings), node.name, node.robot);
}

std::filesystem::path run_file(const services::RunSettings& settings, const std::string& executive,
                               const std::string& name) {
  return settings.run_folder / services_of(settings).file_name(executive, name);
}

}  // namespace roci::exec
