// How far one activity of the running plan has come.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "exec_svc/executive/messages.hpp"

namespace roci::exec::executive {

enum class ActivityPhase {
  waiting,
  sent,         ///< command sent, no answer yet
  running,      ///< accepted, or without a command
  settling,     ///< completed by its owner; shortest duration or post condition still to come
  cancelling,   ///< cancel sent
  contingency,  ///< its command has failed, its contingency runs
  done,
};

enum class AfterCancel { retry, fail, withdraw };

/// A contingency under way.
struct ContingencyRun {
  std::size_t command = 0;  ///< index of the one that runs; as many as there are: all are done
  std::string command_id;
  temporal::Time since{0};
  temporal::Time command_since{0};
  bool accepted = false;
  std::string failure;  ///< of the activity
};

struct ActivityRun {
  ActivityPhase phase = ActivityPhase::waiting;
  temporal::ActivityState state = temporal::ActivityState::waiting;
  std::uint32_t attempt = 0;  ///< part of the command's key: never reset
  std::uint32_t retries_used = 0;
  std::uint32_t contingencies_used = 0;
  std::uint32_t contingency_commands = 0;  ///< part of their keys: never reset
  ContingencyRun contingency;
  std::optional<temporal::Time> started, ended;
  temporal::Time attempt_started{0};
  temporal::Time phase_since{0};
  std::optional<temporal::Time> wait_until;  ///< its wait has begun and ends then
  bool maintenance_held = false;             ///< seen true since the start: from then on it must stay true
  bool overrun_noted = false;                ///< its longest duration has passed and no longer bounds its end
  AfterCancel after_cancel = AfterCancel::fail;
  bool asked = false;  ///< its owner was asked, after a restart, what became of it; not answered yet
  std::string reason;

  bool active() const { return phase != ActivityPhase::waiting && phase != ActivityPhase::done; }
};

}  // namespace roci::exec::executive
