#include "exec_svc/run_files_service.hpp"

#include "exec_svc/journal/salvage.hpp"
#include "services/log/log.hpp"

namespace roci::exec {

using mission::ExecutiveRole;
using roci::mission::ServiceList;

ServiceList services_of(const services::RunSettings& settings) {
  return roci::mission::load_service_list_if_any(settings.mission);
}

ExecutiveRole role_of(const services::RunSettings& settings, const services::node::NodeOptions& node) {
  return mission::role_of(services_of(settings), node.name, node.robot);
}

std::filesystem::path run_file(const services::RunSettings& settings, const std::string& executive,
                               const std::string& name) {
  return settings.run_folder / services_of(settings).file_name(executive, name);
}

std::filesystem::path usable_journal(const std::filesystem::path& file, services::process::DiskPause pause) {
  for (bool waited = false;; waited = true) {
    try {
      journal::salvage_if_damaged(file);
      const std::string lost = journal::Journal(file, journal::Durability::process).watch_extent();
      if (!lost.empty()) services::log::error("exec_svc: " + lost);
      if (waited)
        services::log::warning("exec_svc waited " + std::to_string(pause.over()) + " s for the disk of " +
                               file.string());
      return file;
    } catch (const journal::DiskError& error) {
      if (pause.wait()) services::log::error(std::string("exec_svc waits for its disk: ") + error.what());
    }
  }
}

}  // namespace roci::exec
