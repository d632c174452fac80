#include "tests/engines/planner_process.hpp"

#include <unistd.h>

#include <fstream>

#include "services/transport/plug_ins.hpp"
#include "tests/engines/model/lock.hpp"

namespace roci::planner::proof {

namespace fs = std::filesystem;

PlannerProcess::PlannerProcess(const std::string& engine, const std::string& vendor,
                               const std::string& planner_vendor)
    : folder_(fs::temp_directory_path() /
              ("roci_proof_" + std::to_string(::getpid()) + "_" + std::to_string(domain_.id()))),
      planner_vendor_(planner_vendor) {
  fs::remove_all(folder_);
  fs::create_directories(folder_ / "run");
  std::ofstream(folder_ / "mission.yaml")
      << "name: lock\nmodel: lock.tasks\nplanner:\n  engine: " << engine
      << "\n  function_timeout_s: 1000\n  simulated: {base_s: 0.5, per_evaluation_s: 0}\n";
  std::ofstream(folder_ / "lock.tasks") << kLockModel;
  services::node::NodeOptions options;
  options.name = "exec_svc";
  options.run = "proof";
  options.mission = "lock";
  options.clock = services::clock::ClockMode::master;
  options.master.roster = {"exec_svc", "planner_svc"};
  options.master.restart_hold_s = 1000;
  options.vendor = vendor;
  services::transport::TransportOptions transport;
  transport.domain = domain_.id();
  transport.participant = options.name;
  node_ = std::make_unique<services::Node>(options, services::transport::open_transport(vendor, transport));
  services::subscribe(*node_, services::topics::event, [this](const v1::Event& event) {
    events.push_back(event.code() + ": " + event.text());
  });
  start();
}

PlannerProcess::~PlannerProcess() {
  node_.reset();
  planner_.reset();
  fs::remove_all(folder_);
}

void PlannerProcess::start() {
  planner_ = std::make_unique<services::contract::ChildProcess>(std::vector<std::string>{
      ROCI_BINARY_DIR "/tests/proof_planner", "--mission", folder_.string(), "--run-folder",
      (folder_ / "run").string(), "--run", "proof", "--name", "planner_svc", "--clock", "simulated", "--dds",
      planner_vendor_, "--domain", std::to_string(domain_.id())});
}

void PlannerProcess::kill_and_restart() {
  planner_->kill();
  start();
}

void PlannerProcess::run_until(temporal::Time end) {
  node_->at(end, [this] { node_->stop(); });
  node_->run();
}

}  // namespace roci::planner::proof
