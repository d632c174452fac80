// The owner's side of commands, as docs/protocol-commands.md has it: each key is taken once,
// and says how it ended for good.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "clock.hpp"
#include "command.h"

namespace borehole {

using CommandKey = std::tuple<std::string, std::uint64_t, std::string,
                              std::uint32_t>;  // commander, epoch, activity, attempt

struct CommandStatus {
  v1::CommandStage stage = v1::STAGE_ACCEPTED;
  std::string code{}, reason{};
  double energy_j = NAN;  // NaN: not measured
  std::int64_t duration_us = -1;
};

// What the owner does: begins a new command, or breaks one off and says `why` about it.
class Driver {
 public:
  virtual ~Driver() = default;
  virtual void carry_out(const CommandKey&, const v1::Command&) = 0;
  virtual void break_off(const CommandKey&, const CommandStatus& why) = 0;
};

class Commands {
 public:
  Commands(Clock&, const std::string& owner, Driver&);

  void say(const CommandKey&, CommandStatus);
  // The owner tries again by itself. False: the step's time is over, and the owner fails it.
  bool repair(const CommandKey&, const std::string& reason);
  // When a repaired command must have ended; overrun() breaks it off then.
  std::optional<std::int64_t> next_overrun_us() const;
  void overrun();

 private:
  struct Record {
    std::string robot, subsystem;
    std::int64_t latest_end_us = -1, accepted_us = -1;
    bool repaired = false, cancelling = false;
    CommandStatus status{};
  };
  struct Commander {
    std::uint64_t epoch = 0;
    std::uint32_t incarnation = 0;
    std::uint64_t seq = 0;
  };

  void receive(const v1::Command&);
  bool refused(const v1::Command&);
  void cancel(const v1::Command&, const CommandKey&);
  void stop(const v1::Command&, const CommandKey&);
  Record& take(const v1::Command&, const CommandKey&);
  void raise_epoch(const v1::Command&);
  std::uint64_t newest_epoch(const std::string& commander) const;
  void acknowledge(const CommandKey&, const CommandStatus&, std::uint64_t newest, bool refused_epoch = false);
  void tell(const CommandKey&);

  Clock& clock_;
  const std::string owner_;
  Driver& driver_;
  Output& acks_;
  std::map<CommandKey, Record> records_;
  std::map<std::string, Commander> commanders_;
};

}  // namespace borehole
