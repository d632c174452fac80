// The executive as a service between a robot that obeys and a planner that plans one image for each goal. A
// photo takes 40 s.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "exec_svc/exec_service.hpp"
#include "exec_svc/journal/journal.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::exec::testing {

// A goal at (110, 60).
v1::Goal photo_goal(const std::string& id);

class ExecSeat {
 public:
  // `vendor` of the executive's transport; the others use `vendor_of_others`. `journalled`: what an earlier
  // start left in the journal. `mission`: its folder.
  explicit ExecSeat(const std::string& vendor = "inproc", const std::string& vendor_of_others = "inproc",
                    int domain = services::next_domain(),
                    const std::vector<goals::GoalRecord>& journalled = {},
                    std::filesystem::path mission = ROCI_SOURCE_DIR "/missions/planetary");
  ~ExecSeat();

  void send(temporal::Time when, const v1::Goal& goal);
  // The executive dies then without a word, and starts again as its next incarnation.
  void kill_executive_at(temporal::Time when);
  // The planner dies; `begun_anew` is called with its next incarnation, before it runs.
  void kill_planner_at(temporal::Time when, std::function<void(services::Node&)> begun_anew);
  // The planner is back before the executive.
  void kill_both_at(temporal::Time when);
  void at(temporal::Time when, std::function<void()> what) { robot_.at(when, std::move(what)); }
  void run_until(temporal::Time end);

  services::SimRun& run() { return run_; }
  services::Node& robot() { return robot_; }
  // As after a crash: what stands in the file now.
  journal::Journal journal() const {
    return journal::Journal(folder_ / "journal.sqlite", journal::Durability::process);
  }
  std::string summary() const;

  // The robot has taken commands of this epoch, as its ledger says.
  std::uint64_t held_epoch = 0;
  // What the robot acknowledges seems to come from this owner; empty: from itself.
  std::string acknowledged_by;
  std::vector<std::string> statuses;  // "id state reason", as they came
  std::vector<std::string> events;    // codes
  std::vector<v1::Command> commands;
  std::vector<v1::Plan> plans;
  v1::MissionStatus mission;
  int planner_calls = 0;

 private:
  void start_executive(std::uint32_t incarnation);
  void serve_plans(services::Node& planner);
  void obey(const v1::Command& command);
  void tell(const std::string& activity, std::uint32_t attempt, v1::CommandStage stage);
  void observe(const std::string& timeline, const temporal::Value& value);

  std::filesystem::path folder_;
  std::filesystem::path mission_;
  std::string vendor_, vendor_of_others_;
  services::SimRun run_;
  services::Node& robot_;
  services::Publisher<v1::Goal> goals_;
  services::Publisher<v1::Observation> observations_;
  services::Publisher<v1::CommandAck> acks_;
  std::unique_ptr<services::Service> executive_;
  std::map<std::pair<std::string, std::uint32_t>, v1::CommandStage> messages_;  // the last on each key
  bool killed_ = false;
  std::function<void(services::Node&)> planner_begun_anew_;  // if it is killed
};

}  // namespace roci::exec::testing
