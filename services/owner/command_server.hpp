// The command server takes the commands of one owner on its node: requests come in by the topic `command`,
// the ledger applies the rules, the driver does what is to be done, and its statuses go out by `command_ack`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/node.hpp"
#include "services/owner/command_ledger.hpp"
#include "services/owner/commander_leases.hpp"
#include "services/owner/ledger_file.hpp"
#include "services/publisher.hpp"

namespace roci::services::owner {

/// Does what is particular to an owner. It answers through the server, within the call or later, on the
/// node's loop.
class Driver {
 public:
  virtual ~Driver() = default;
  /// Reports what has happened by now; it is called before each request, so that this is said first.
  virtual void catch_up() {}
  /// Carries out a new command. The answer is say(accepted) or say(rejected), and one last status when it has
  /// ended.
  virtual void carry_out(const Request&) = 0;
  /// Ends the command early; `why` is the status to say when it has ended (cancelled on request, stopped, or
  /// failed by an overrun). A driver that cannot break off says refuse_cancel().
  virtual void break_off(const CommandKey&, const CommandStatus& why) = 0;
  /// Is told that somebody has asked what became of the command, before that one is answered.
  virtual void asked_about(const CommandKey&) {}
};

/// Holds a command of an earlier process that the driver is able to go on with.
struct Resumed {
  Request request;
  temporal::Time accepted{};
};

/// Applies the ledger's rules to requests from the wire and lets the driver act. It must live as long as the
/// node's loop runs, and the driver must outlive it.
class CommandServer {
 public:
  CommandServer(Node&, Driver&);
  CommandServer(const CommandServer&) = delete;
  CommandServer& operator=(const CommandServer&) = delete;

  /// By default the server breaks off what a stopped subsystem runs, and says that the stop is completed. A
  /// driver that knows its subsystems better gets stops by carry_out(), like other commands.
  void leave_stops_to_driver() { driver_stops_ = true; }

  /// Keeps keys, last statuses and epochs in this file, before anything is done about them, and takes up what an
  /// earlier process of this owner left there: it does not carry out again what that one has begun, and answers
  /// queries as it would have. What that one had not ended has failed (`owner-restarted`), but for the command that the
  /// driver resumes. To be called before the loop runs. Returns whether there is such a one. Throws std::runtime_error
  /// if the file cannot be read or written.
  bool keep_in(const std::filesystem::path& file, const std::optional<Resumed>& resumed = {});
  /// Sends the newest word on a command again: the process that sent it may have died before anybody heard.
  void say_again(const CommandKey&);

  /// These return false if the ledger has no such command, or it has ended (command_ledger.hpp).
  bool say(const CommandKey&, CommandStatus);
  bool refuse_cancel(const CommandKey&, std::string reason);
  /// Returns false if there is no time for a repair; the driver fails the command then.
  bool repair(const CommandKey&, std::string reason);

 private:
  void receive(const Request&);
  void receive(const v1::LeaseRequest&);
  bool holds_lease(const Request&);
  void stop(const Request&);
  void keep();
  bool begin_file_anew();
  void announce(const Notice&);
  bool send(const std::optional<Ack>&);
  void watch_overruns();

  Node& node_;
  Driver& driver_;
  CommandLedger ledger_;
  CommanderLeases leases_;
  std::optional<LedgerFile> file_;
  std::vector<LedgerEntry> unwritten_;  // what the disk has not taken yet, in order
  Publisher<v1::CommandAck> acks_;
  Publisher<v1::LeaseState> lease_states_;
  Publisher<v1::Event> events_;
  std::map<std::string, temporal::Time> announced_;  // when operators were last told, by code and text
  bool driver_stops_ = false;
  std::optional<Node::TimerId> overrun_;
};

}  // namespace roci::services::owner
