// The kit of whoever commands subsystems and is no planner's executive: sends a command until it is heard, and tells
// its owner's last status once. The counterpart of services/owner, whose rules on keys and epochs it keeps.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "services/node.hpp"
#include "services/owner/command.hpp"
#include "services/publisher.hpp"

namespace roci::services::commander {

/// Holds a command to a subsystem. (activity, attempt) is never used for another one in the run.
struct Call {
  std::string owner;  ///< service that executes it
  std::string robot;  ///< robot that has the subsystem; empty: the owner's only one
  std::string subsystem;
  std::string command;
  std::map<std::string, std::string> arguments{};
  std::string activity;
  std::uint32_t attempt = 1;
  std::uint32_t plan = 0;  ///< version of the plan; never falls
  std::optional<temporal::Time> latest_end{};
};

/// Holds what must outlive the process for settle(): the key of a command, and the owner that it went to.
struct Issued {
  owner::CommandKey key;
  std::string owner;
  bool operator==(const Issued&) const = default;
};

/// Sends each command in the name of its node until the owner has heard it, and reports its last word once.
/// It must live as long as the node's loop runs.
class CommandClient {
 public:
  /// Called once with the owner's last status: completed, failed, cancelled or rejected. Failures of our own have the
  /// codes `no-answer` and `owner-lost`; with settle() `unknown` says that the owner has never heard of it.
  using OnEnd = std::function<void(const owner::CommandStatus&)>;
  /// Called before a key goes out for the first time; what it does not keep is forgotten with the process.
  using OnIssue = std::function<void(const Issued&)>;

  /// Say after how long without an answer an owner is asked again, and how often.
  static constexpr temporal::Duration kAnswerWithin = std::chrono::seconds(10);
  static constexpr int kAsks = 3;

  /// Begins in `epoch`, which must be above all in which this name has commanded before. An owner that knows a later
  /// one raises it further.
  CommandClient(Node& node, std::uint64_t epoch, OnIssue on_issue);
  CommandClient(const CommandClient&) = delete;
  CommandClient& operator=(const CommandClient&) = delete;

  /// Sends a command. `on_end` runs on the loop, never within call().
  void call(const Call& what, OnEnd on_end);
  /// Goes on with a command of an earlier process of this name, by its old key: its end is reported as that of
  /// call(); if its owner has never heard of it, it is sent.
  void adopt(const Issued& issued, const Call& what, OnEnd on_end);
  /// Asks to end a command early; its end is reported as usual. Does nothing if it is not under way.
  void cancel(const std::string& activity, std::uint32_t attempt);
  /// Finds out what became of a command of an earlier process of this name, and ends it if it still runs. `robot` and
  /// `subsystem` need not be known: an owner finds what it took by the key.
  void settle(const Issued& issued, OnEnd on_end);

  std::uint64_t epoch() const { return epoch_; }

 private:
  struct UnderWay {
    Call call;
    std::uint64_t issued = 0;  // epoch
    OnEnd on_end;
    bool ours = true;  // false: an earlier process sent it
    bool accepted = false;
    bool cancelling = false;
    int asked = 0;
    std::optional<Node::TimerId> timer;
  };
  using Key = std::pair<std::string, std::uint32_t>;

  void issue(UnderWay& one);
  void send(const UnderWay& one, v1::CommandAction action);
  void await(const Key& key);
  void ask_again(const Key& key);
  void hear(const v1::CommandAck& ack);
  void take(const Key& key, UnderWay& one, const v1::CommandAck& ack);
  void end(const Key& key, owner::CommandStatus status);

  Node& node_;
  std::uint64_t epoch_;
  OnIssue on_issue_;
  Publisher<v1::Command> commands_;
  std::map<Key, UnderWay> under_way_;
};

}  // namespace roci::services::commander
