// An activity's run says how far one activity of the running plan has come.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "exec_svc/executive/messages.hpp"

namespace roci::exec::executive {

/// Says how far an activity has come, finer than ActivityState, which everybody sees.
enum class ActivityPhase {
  waiting,
  sent,         ///< command sent, no answer yet
  running,      ///< accepted, or without a command
  settling,     ///< completed by its owner; shortest duration or post condition still to come
  cancelling,   ///< cancel sent
  contingency,  ///< its command has failed, its contingency runs
  done,
};

/// Says what follows when a cancel has been answered.
enum class AfterCancel { retry, fail, withdraw };

/// Holds all that the run knows of one activity.
struct ActivityRun {
  ActivityPhase phase = ActivityPhase::waiting;
  temporal::ActivityState state = temporal::ActivityState::waiting;
  std::uint32_t attempt = 0;  ///< part of the command's key: each command sent anew counts, none is reset
  std::size_t command = 0;    ///< index, in the activity's sequence, of the command under way
  std::uint64_t epoch = 0;    ///< executive's epoch when it issued this attempt: part of the key, too
  std::uint32_t plan = 0;     ///< version of the plan that issued it: its owner tells old keys by it
  std::uint32_t issued = 0;   ///< the newest attempt that was sent
  std::uint32_t retries_used = 0;
  std::optional<temporal::Time> started, ended;
  temporal::Time attempt_started{0};
  temporal::Time phase_since{0};
  temporal::Time latest_end = temporal::no_bound;  ///< told to its owner: no repair is worth trying after it
  std::optional<temporal::Time> wait_until;        ///< its wait has begun and ends then
  bool maintenance_held = false;  ///< seen true since the start: from then on it must stay true
  bool overrun_noted = false;     ///< its longest duration has passed and no longer bounds its end
  AfterCancel after_cancel = AfterCancel::fail;
  bool asked = false;          ///< its owner was asked what became of it; not answered yet
  std::uint32_t queries = 0;   ///< how often it was asked in this phase because no answer came over a link
  std::uint32_t refusals = 0;  ///< how often its owner refused the epoch in this phase
  std::string reason;

  bool active() const { return phase != ActivityPhase::waiting && phase != ActivityPhase::done; }
};

}  // namespace roci::exec::executive
