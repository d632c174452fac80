// A robot that takes images and remembers every command, a planner, a ground; and an executive among them
// that dies and comes back where the test wants it. What they say stays for who joins later, as on state
// topics.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/journal/journaled_reactor.hpp"
#include "services/owner/command_ledger.hpp"

namespace roci::exec::testing {

// Of the turn in which the executive dies.
enum class Moment {
  before_write_ahead,  // what came in is lost with it
  after_write_ahead,   // decided and journaled, nothing sent
  during_send,         // the first command was sent
  after_send,
};

struct CrashPlan {
  std::set<std::size_t> turns;  // counted over the whole flight
  Moment moment = Moment::after_send;
  temporal::Duration away{0};  // until it is back; the robot goes on meanwhile
  bool compact = false;        // the journal forgets inputs before the newest anchor
  Replanning replanning = Replanning::paused;
};

struct Flight {
  std::map<std::string, GoalState> goals;
  std::map<std::string, int> images;                                 // how often each was begun
  std::map<std::pair<std::string, std::uint32_t>, int> carried_out;  // commands by key
  std::uint32_t plan_version = 0;
  std::size_t turns = 0;
  std::size_t not_resumed = 0;
  std::string outcome;
  std::string trace_sha256;
};

class CrashWorld {
 public:
  explicit CrashWorld(const CrashPlan& crash);
  ~CrashWorld();

  void send(double at_s, const GoalRequest& goal);
  void break_shutter_once(const std::string& image) { broken_.insert(image); }
  Flight fly(double until_s);
  const std::filesystem::path& file() const { return file_; }

 private:
  struct Dead {};
  void start();
  void turn();
  void deliver(const ReactorOutputs& out);
  void obey(const Command& command);
  void take_image(const Command& command);
  void tell(const Command& command, CommandStage stage, const std::string& code = "");
  void observe(const std::string& timeline, const temporal::Value& value);
  void later(temporal::Duration delay, std::function<void()> what);

  std::filesystem::path file_;
  CrashPlan crash_;
  MissionModel mission_;
  std::optional<Journal> journal_;
  std::unique_ptr<JournaledReactor> executive_;
  int incarnation_ = 0;

  temporal::Time now_{0};
  std::multimap<temporal::Time, std::function<void()>> events_;
  std::optional<temporal::Time> wake_;
  ReactorInputs pending_;
  // For who joins later: the newest of each key.
  std::map<std::string, Observation> observations_;
  std::map<services::owner::CommandKey, CommandAck> acks_;
  std::map<GoalKey, GoalRequest> goals_;

  services::owner::CommandLedger ledger_;
  std::optional<Command> imaging_;
  std::set<std::string> broken_;
  Flight flight_;
};

}  // namespace roci::exec::testing
