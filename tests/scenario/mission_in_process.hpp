// The planetary mission with every real service in this process, and a ground that sends goals at chosen
// mission times and hears what becomes of them.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "services/publisher.hpp"
#include "services/service.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::scenario {

struct GoalFate {
  std::vector<v1::GoalState> states;  // in order, each once
  std::string reason;                 // of the last
};

class MissionInProcess {
 public:
  // The folder of a mission; files of it that `changed` names are replaced by these texts.
  explicit MissionInProcess(const std::map<std::string, std::string>& changed = {}, std::uint64_t seed = 1);
  ~MissionInProcess();

  void send(temporal::Time when, const v1::Goal& goal);
  void run();

  const std::map<std::string, GoalFate>& goals() const { return goals_; }  // by id
  const GoalFate& goal(const std::string& id) const { return goals_.at(id); }
  const v1::MissionStatus& mission() const { return mission_; }
  // "code text" of each.
  const std::vector<std::string>& events() const { return events_; }
  const std::vector<v1::Plan>& plans() const { return plans_; }
  // Every state of every activity, as told.
  const std::vector<v1::StepStatus>& steps() const { return steps_; }
  // The planner calls, as sent.
  const std::vector<v1::PlanRequest>& calls() const { return calls_; }
  const std::filesystem::path& run_folder() const { return run_folder_; }

 private:
  std::filesystem::path folder_;
  std::filesystem::path run_folder_;
  services::SimRun run_;
  services::Node& ground_;
  services::Publisher<v1::Goal> goals_out_;
  std::vector<std::unique_ptr<services::Service>> services_;
  std::map<std::string, GoalFate> goals_;
  v1::MissionStatus mission_;
  std::vector<std::string> events_;
  std::vector<v1::Plan> plans_;
  std::vector<v1::StepStatus> steps_;
  std::vector<v1::PlanRequest> calls_;
};

// The text of a file of the planetary mission, with every `from` replaced.
std::string planetary_file(const std::string& name, const std::string& from = "", const std::string& to = "");

v1::Goal goal(const std::string& id, const std::string& kind,
              const std::vector<std::pair<std::string, std::string>>& arguments,
              v1::GoalClass importance = v1::GOAL_HARD, double utility = 0);

}  // namespace roci::scenario
