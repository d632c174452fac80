// A planner in a process of its own, and this program as all others: the master of the simulated clock, who asks,
// owns functions and executes.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "roci_idl/planner.h"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/contract/support/child_process.hpp"

namespace roci::planner::proof {

class PlannerProcess {
 public:
  // `engine`: that the mission names, with the lock as its model. `vendor`: of this program; `planner_vendor`: of
  // the planner.
  PlannerProcess(const std::string& engine, const std::string& vendor, const std::string& planner_vendor);
  ~PlannerProcess();

  services::Node& node() { return *node_; }
  // SIGKILL, and a new process at once; mission time waits for it.
  void kill_and_restart();
  // Everything goes on until this mission time.
  void run_until(temporal::Time end);

  std::vector<std::string> events;  // "code: text"

 private:
  void start();

  services::process::DomainClaim domain_;
  std::filesystem::path folder_;
  std::string planner_vendor_;
  std::unique_ptr<services::Node> node_;
  std::unique_ptr<services::contract::ChildProcess> planner_;
};

struct Pairing {
  const char* name;
  std::string own;
  std::string planner;
};
inline const std::vector<Pairing> kPairings = {{"fastdds", "fastdds", "fastdds"},
                                               {"cyclonedds", "cyclonedds", "cyclonedds"},
                                               {"mixed", "fastdds", "cyclonedds"}};

}  // namespace roci::planner::proof
