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
  explicit MissionInProcess(const std::map<std::string, std::string>& changed = {});
  ~MissionInProcess();

  void send(services::Time when, const v1::Goal& goal);
  void run();

  const std::map<std::string, GoalFate>& goals() const { return goals_; }  // by id
  const GoalFate& goal(const std::string& id) const { return goals_.at(id); }
  const v1::MissionStatus& mission() const { return mission_; }
  // "code text" of each.
  const std::vector<std::string>& events() const { return events_; }
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
};

v1::Goal goal(const std::string& id, const std::string& kind,
              const std::vector<std::pair<std::string, std::string>>& arguments,
              v1::GoalClass importance = v1::GOAL_HARD, double utility = 0);

}  // namespace roci::scenario
