// Repairs are what owners of commands mend by themselves (R146), as their words on commands tell. They are plain
// values, without DDS.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "roci_idl/command.h"

namespace roci::console::lib {

/// Describes what an owner does to end a command well although something went wrong.
struct Repair {
  enum class State { under_way, mended, failed };

  std::string owner;  ///< e.g. the dedicated executive
  std::string robot;  ///< whose; empty: not known
  std::string commander;
  std::string activity;
  std::string error;          ///< in the owner's words; the newest, if there were several in one command
  std::uint32_t times = 1;    ///< so often it has begun one within the command, as far as was heard
  std::int64_t since_us = 0;  ///< mission time of the first word that was heard of it
  /// It must have ended by then; -1: no bound, or the command was not heard.
  std::int64_t latest_end_us = -1;
  State state = State::under_way;
  std::int64_t ended_us = -1;
  std::string end{};  ///< code and reason of the last word on the command, if it failed
};

const char* name_of(Repair::State state);  ///< "under way", "mended", "failed"

/// Returns how much of the time from its first word to the latest end is used, from 0 on; beyond 1 it is late.
/// Negative: no bound is known.
double share_used(const Repair& repair, std::int64_t now_us);

/// Tells which commands their owners repair by themselves, from the words on them.
class Repairs {
 public:
  using Key = std::tuple<std::string, std::uint64_t, std::string, std::uint32_t>;  ///< of the command

  /// Both return false where there is no room for something new.
  bool take(const v1::Command& command);
  bool take(const v1::CommandAck& word);

  const std::map<Key, Repair>& all() const { return repairs_; }

 private:
  struct Asked {
    std::string robot;
    std::int64_t latest_end_us;
  };

  std::map<Key, Asked> asked_;  // commands that have not ended
  std::map<Key, Repair> repairs_;
};

}  // namespace roci::console::lib
