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
  mission::Replanning replanning = mission::Replanning::stop_and_replan;
  std::uint32_t kept_records = 20'000;  // of texts, where inputs are forgotten
};

struct Flight {
  std::map<std::string, goals::GoalState> goals;
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

  void send(double at_s, const goals::GoalRequest& goal);
  void break_shutter_once(const std::string& image) { broken_.insert(image); }
  Flight fly(double until_s);
  const std::filesystem::path& file() const { return file_; }

 private:
  struct Dead {};
  void start();
  void turn();
  void deliver(const reactor::ReactorOutputs& out);
  void obey(const executive::Command& command);
  void take_image(const executive::Command& command);
  void tell(const executive::Command& command, executive::CommandStage stage, const std::string& code = "");
  void observe(const std::string& timeline, const temporal::Value& value);
  void later(temporal::Duration delay, std::function<void()> what);

  std::filesystem::path file_;
  CrashPlan crash_;
  mission::MissionModel mission_;
  std::optional<journal::Journal> journal_;
  std::unique_ptr<journal::JournaledReactor> executive_;
  int incarnation_ = 0;

  temporal::Time now_{0};
  std::multimap<temporal::Time, std::function<void()>> events_;
  std::optional<temporal::Time> wake_;
  reactor::ReactorInputs pending_;
  // For who joins later: the newest of each key.
  std::map<std::string, executive::Observation> observations_;
  std::map<services::owner::CommandKey, executive::CommandAck> acks_;
  std::map<goals::GoalKey, goals::GoalRequest> goals_;

  services::owner::CommandLedger ledger_;
  std::optional<executive::Command> imaging_;
  std::set<std::string> broken_;
  Flight flight_;
};

}  // namespace roci::exec::testing
