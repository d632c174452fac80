/// Where an executive stands among the services of its mission, and the names of its files in the run folder
/// that all of them share.
#pragma once

#include <filesystem>
#include <string>

#include "core/mission/service_list.hpp"
#include "exec_svc/mission/executive_role.hpp"
#include "services/process/disk_pause.hpp"
#include "services/service.hpp"

namespace roci::exec {

/// The mission's list; empty where mission.yaml has none. Throws roci::mission::FileError.
roci::mission::ServiceList services_of(const services::RunSettings&);

mission::ExecutiveRole role_of(const services::RunSettings&, const services::node::NodeOptions&);

/// The path of a file in the run folder; with several executives each has one with its own name before it.
std::filesystem::path run_file(const services::RunSettings&, const std::string& executive,
                               const std::string& name);

/// Returns `file` once a journal can be opened there: a damaged one has been salvaged (journal/salvage.hpp), one that
/// has lost its end says so (Journal::watch_extent), and while the disk takes nothing it waits, which the log tells.
/// Throws as salvage_if_damaged() does, but no DiskError.
std::filesystem::path usable_journal(const std::filesystem::path& file, services::process::DiskPause);

}  // namespace roci::exec
