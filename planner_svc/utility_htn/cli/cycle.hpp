// Plans the cycles of a flight again, alone, from the record of what the engine heard
// (planner_svc/engine/step_record.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string>
#include <string_view>
#include <vector>

#include "planner_svc/engine/step_record.hpp"
#include "planner_svc/utility_htn/cli/commands.hpp"

namespace roci::planner::utility_htn::cli {

/// Compares a step of the record that had something to do: as it was flown, and as it was planned again.
struct ReplannedCycle {
  std::uint64_t number = 0;  ///< counts from 1
  std::uint64_t step = 0;    ///< of the record, from 1: most steps hear something and plan nothing
  temporal::Time at{0};
  engine::StepOutcome now{};
  std::optional<engine::StepOutcome> flown{};  ///< nothing: the process ended in it
  /// Says what the independent checker finds wrong with what is told of data and downlinks then.
  std::vector<std::string> downlink_faults{};
  bool as_flown() const { return !flown || *flown == now; }
};

/// Counts what a record held, in how many of its cycles the engine planned otherwise than it had in flight, and what
/// the checker of downlink schedules says.
struct Replanned {
  std::uint64_t cycles = 0;
  std::uint64_t steps = 0;
  std::uint64_t versions = 0;
  std::uint64_t differing = 0;  ///< cycles
  std::uint64_t schedules = 0;  ///< of downlinks, which the independent checker has computed anew
  std::uint64_t faulty = 0;     ///< cycles with a fault in theirs
  bool cut_short = false;       ///< the record ends within an entry
};

/// Makes an engine of the record and gives it one step after the other, up to the cycle `until` (0: all). `told` hears
/// of each cycle. Throws engine::StepRecordError for a record that is damaged, and std::invalid_argument for one of
/// another engine or with a network that cannot be used.
Replanned plan_again(std::string_view record, std::uint64_t until,
                     const std::function<void(const ReplannedCycle&)>& told);

/// Prints each cycle with what it did and the checksum of its version, and whether all is as it was flown. Ends with
/// `faulty` where something is not or a schedule of downlinks has a fault, and for a record that is damaged.
ExitCode cycle(const std::filesystem::path& record, std::uint64_t until, const Output& output);

}  // namespace roci::planner::utility_htn::cli
