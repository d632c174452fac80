// A house is the processes of one mission and idle ones beside them, started here, watched over DDS.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/house/proc.hpp"
#include "roci_idl/clock.h"
#include "services/clock/wall.hpp"
#include "services/process/domain_claim.hpp"
#include "services/launch/child.hpp"
#include "services/node.hpp"

namespace roci::bench::house {

/// Says which mission flies, and in how many processes.
struct HouseOptions {
  std::filesystem::path bin;  ///< The services stand there.
  std::filesystem::path mission;
  std::string scenario = "nominal";
  std::string dds = "fastdds";
  std::uint64_t seed = 1;
  int processes = 7;  ///< Counts this one, too, which stands in the place of roci-launch.
  double pace = 0;    ///< Mission seconds per second; 0: as fast as possible.
};

/// Holds what the clock did, as an observer heard it.
struct ClockFigures {
  double sim_s = 0;               ///< Is the mission time of the newest step.
  std::uint64_t micro_steps = 0;  ///< Counts numbered ones; a time of which no step was heard is missed.
  std::uint64_t samples = 0;      ///< Counts those of clocked topics, by all senders.
};

/// Starts the processes of a house and ends them with itself.
class House {
 public:
  /// Starts the processes; their logs go to `run_folder`. Throws std::system_error and
  /// services::TransportError.
  House(const HouseOptions& options, const std::filesystem::path& run_folder);
  ~House();
  House(const House&) = delete;
  House& operator=(const House&) = delete;

  /// Listens until the clock runs. Throws std::runtime_error when a process ends before, or after a minute.
  void wait_for_clock();
  void listen(std::chrono::duration<double> time);
  /// Listens until all processes have ended by themselves. Returns false if some have not, ten minutes later.
  bool wait_for_end();

  /// These return seconds from the first process's start, or nothing if it has not come.
  std::optional<double> first_step_s() const { return first_step_s_; }
  std::optional<double> first_command_s() const { return first_command_s_; }
  std::optional<double> last_step_s() const { return last_step_s_; }
  const ClockFigures& clock() const { return clock_; }
  /// Returns the figures of all processes that live, this one included.
  ProcessFigures figures() const;

 private:
  void start(const HouseOptions& options, const std::filesystem::path& run_folder);
  void take(const v1::ClockStep& step);
  bool any_ended();
  bool all_ended();
  double since_begin() const;

  services::process::DomainClaim domain_;
  services::clock::WallTime begun_;
  std::unique_ptr<services::Node> node_;
  std::vector<std::unique_ptr<services::launch::Child>> children_;
  ClockFigures clock_;
  std::int64_t step_time_us_ = -1;
  std::uint32_t micro_step_ = 0;
  std::optional<double> first_step_s_;
  std::optional<double> last_step_s_;
  std::optional<double> first_command_s_;
};

}  // namespace roci::bench::house
