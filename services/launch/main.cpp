// roci-launch flies a mission with every service in its own process; see README.md in this folder.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <iostream>
#include <system_error>

#include "core/mission/entry.hpp"
#include "core/mission/scenario.hpp"
#include "services/clock/host_anchor.hpp"
#include "services/launch/anchor_file.hpp"
#include "services/launch/options.hpp"
#include "services/launch/process_plan.hpp"
#include "services/launch/run.hpp"
#include "services/process/clock_watch.hpp"
#include "services/process/private_folder.hpp"
#include "services/process/service_options.hpp"
#include "services/process/stop_signals.hpp"
#include "services/transport/plug_ins.hpp"

namespace {

namespace launch = roci::services::launch;
namespace process = roci::services::process;

// Turns this process into another program, which stands beside it unless it is a path.
int become(const std::filesystem::path& name, std::vector<std::string> arguments) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
  setenv("ROCI_PLUGIN_PATH", roci::services::transport::plugin_path().c_str(), 1);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  throw std::system_error(errno, std::generic_category(), "cannot start " + program.string());
}

// Each service of this host, and each start of it, finds the anchor of the first one in the folder that they share.
// This process does not stay to watch the system clock: one of them does.
void hand_anchor(const std::filesystem::path& folder, std::int64_t epoch_us) {
  if (folder.empty()) return;
  process::make_own_folder(folder);
  if (const auto anchor = launch::kept_anchor(folder, epoch_us))
    setenv(roci::services::clock::kHostAnchorVariable, to_text(*anchor).c_str(), 1);
  setenv(process::kClockWatchVariable, "1", 1);
}

// What the simulated world would refuse at its start is told before anything starts.
void require_scenario(const launch::Options& options) {
  const roci::mission::ServiceEntry* master = options.list.clock_master();
  const bool here = !options.live && master != nullptr &&
                    std::ranges::find(options.services, master->name) != options.services.end();
  if (here && master->program == "sim_svc") roci::mission::load_scenario(options.mission, options.scenario);
}

int start(int argc, char** argv) {
  const launch::Options options = launch::parse_options(argc, argv, process::process_environment());
  if (!options.become.empty()) {
    const auto epoch_us = static_cast<std::int64_t>(options.epoch_s * 1e6);
    hand_anchor(options.run_folder, epoch_us);
    return become(launch::program_of(options, options.become),
                  launch::service_arguments(options, options.become, 0, epoch_us));
  }
  if (options.connection.dds == "inproc")
    return become("roci-rehearse", launch::rehearsal_arguments(options));
  require_scenario(options);
  process::StopSignals signals;
  std::atomic<int> stops{0};
  const process::StopWatch stop(signals, [&stops] { ++stops; });
  return launch::fly(options, [&stops] { return stops.load(); });
}

int report(const std::exception& error, launch::ExitCode code) {
  std::cerr << "roci-launch: " << error.what() << "\n";
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return start(argc, argv);
  } catch (const process::CommandLineEnd& end) {
    (end.exit_code == 0 ? std::cout : std::cerr) << end.what();
    return end.exit_code;
  } catch (const roci::mission::FileError& error) {
    return report(error, launch::kBadInput);
  } catch (const std::invalid_argument& error) {
    return report(error, launch::kBadInput);
  } catch (const std::exception& error) {
    return report(error, launch::kServiceFailed);
  }
}
