// This file has the epoch in which an executive commands, and what follows where an owner holds another one.
#pragma once

#include <cstdint>
#include <functional>

#include "exec_svc/output_publisher_service.hpp"
#include "exec_svc/strangers.hpp"
#include "services/topics/topics.hpp"

namespace roci::exec {

namespace journal {
class Journal;
}
namespace standby {
class LeaderService;
}  // namespace standby

/// Holds the epoch in which this executive commands, and moves on where an owner holds a later one.
class CommandEpoch {
 public:
  /// With a `leader` (of a pair) that one decides what follows where an owner holds a later epoch; without one the
  /// executive begins the epoch after it and calls `begin` with it. All arguments must outlive this object.
  CommandEpoch(const services::Node&, journal::Journal&, OutputPublisher&, Strangers&,
               standby::LeaderService* leader, std::uint64_t epoch, std::function<void(std::uint64_t)> begin);

  std::uint64_t number() const { return epoch_; }

  /// Takes in that an owner refused the epoch of a command. Returns whether the refused command is to be sent again,
  /// in the epoch that has begun since.
  bool take_refusal(const v1::CommandAck&);

 private:
  void follow(const v1::CommandAck&);

  const services::Node& node_;
  journal::Journal& journal_;
  OutputPublisher& publisher_;
  Strangers& strangers_;
  standby::LeaderService* leader_;  // none: no other executive follows
  std::uint64_t epoch_;
  std::function<void(std::uint64_t)> begin_;
};

}  // namespace roci::exec
