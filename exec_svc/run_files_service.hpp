// This file finds an executive among the services of its mission, and names its files in the shared run
// folder.
#pragma once

#include <filesystem>
#include <string>

#include "core/mission/service_list.hpp"
#include "exec_svc/mission/executive_role.hpp"
#include "services/process/disk_pause.hpp"
#include "services/service.hpp"

namespace roci::exec {

/// Returns the mission's list of services, empty where mission.yaml has none. Throws
/// roci::mission::FileError.
roci::mission::ServiceList services_of(const services::RunSettings&);

mission::ExecutiveRole role_of(const services::RunSettings&, const services::node::NodeOptions&);

/// Returns the path of a file in the run folder; with several executives each one's name stands before the
/// file's.
std::filesystem::path run_file(const services::RunSettings&, const std::string& executive,
                               const std::string& name);

/// Returns `file` once a journal can be opened there: a damaged one has been salvaged (journal/salvage.hpp), one that
/// has lost its end says so (Journal::watch_extent), and while the disk takes nothing it waits, which the log tells.
/// Throws as salvage_if_damaged() does, but no DiskError.
std::filesystem::path usable_journal(const std::filesystem::path& file, services::process::DiskPause);

}  // namespace roci::exec
