// The clock watch reports that the system clock of a host is set, where no launcher does: systemd starts each
// service by itself.
#pragma once

#include <filesystem>
#include <optional>

#include "services/clock/host_anchor.hpp"
#include "services/clock/wall.hpp"
#include "services/node.hpp"
#include "services/publisher.hpp"

namespace roci::services::process {

/// Names the environment variable ("1") that leaves the watch to a live service: `roci-launch --become` sets it,
/// whereas a launcher that stays watches itself.
inline constexpr char kClockWatchVariable[] = "ROCI_CLOCK_WATCH";

/// Lets one of a host's services watch: the one that holds the lock on the file `clock-watch` of their shared run
/// folder. It reports by the log and the event `clock.set`, in the launcher's words; when it ends, another one goes on
/// and says again how far the clocks are apart. It does nothing unless the variable is set, the node is live and was
/// handed the anchor of its host. It must live as long as the node's loop runs.
class ClockWatch {
 public:
  ClockWatch(Node&, const std::filesystem::path& run_folder);
  ~ClockWatch();
  ClockWatch(const ClockWatch&) = delete;
  ClockWatch& operator=(const ClockWatch&) = delete;

 private:
  void turn();
  bool is_mine();

  const std::filesystem::path file_;
  Publisher<v1::Event> events_;
  clock::SystemClockWatch watch_;
  clock::WallTime next_{};
  std::optional<std::string> untold_;  // while nobody could hear of it
  int lock_ = -1;
};

}  // namespace roci::services::process
