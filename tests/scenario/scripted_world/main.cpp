// The world of a test: a robot, an engine and a ground in one process, which drives the simulated clock in
// the place of sim_svc. In `heard.json` of the run folder it tells what it has heard and begun.
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "services/process/service_main.hpp"
#include "tests/scenario/scripted_world/script.hpp"

namespace roci::scenario {
namespace {

using namespace std::chrono_literals;

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

v1::Goal goal_of_the_run() {
  v1::Goal goal;
  goal.issuer("ground");
  goal.id("end");
  goal.goal_kind("photo");
  for (const char* name : {"x", "y"}) {
    v1::Property argument;
    argument.name(name);
    argument.value("60");
    goal.arguments().push_back(argument);
  }
  return goal;
}

class ScriptedWorld final : public services::Service {
 public:
  ScriptedWorld(services::Node& node, const services::RunSettings& settings)
      : robot_(node),
        script_(make_script(node, robot_)),
        goals_(services::advertise(node, services::topics::goal)),
        heard_(settings.run_folder / "heard.json") {
    node.at(1s, [this] { goals_.write(goal_of_the_run()); });
    node.at(3600s, [&node] { node.stop(); });
    services::subscribe(node, services::topics::mission_status, [&node](const v1::MissionStatus& status) {
      if (status.outcome() == "achieved") node.after(1s, [&node] { node.stop(); });
    });
  }
  ~ScriptedWorld() override {
    nlohmann::json out = script_->heard();
    out["begun"] = robot_.begun();
    std::ofstream(heard_) << out.dump(1) << "\n";
  }

 private:
  CameraRobot robot_;
  std::unique_ptr<Script> script_;
  services::Publisher<v1::Goal> goals_;
  std::filesystem::path heard_;
};

}  // namespace

std::unique_ptr<Script> make_script(services::Node& node, CameraRobot& robot) {
  if (setting("ROCI_TEST_SCRIPT") == "decisions")
    return make_decision_script(node, robot, setting("ROCI_TEST_RESOLVER"));
  if (setting("ROCI_TEST_SCRIPT") == "orders") return make_order_script(node, robot);
  throw std::runtime_error("ROCI_TEST_SCRIPT names no script");
}

std::unique_ptr<services::Service> make_world(services::Node& node, const services::RunSettings& settings) {
  return std::make_unique<ScriptedWorld>(node, settings);
}

}  // namespace roci::scenario

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "sim_svc", roci::scenario::make_world);
}
