// What a scripted world does beside its robot: it sends the plan as an engine that plans all the time, and
// says what the test is about.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/temporal/plan_delta.hpp"
#include "services/publisher.hpp"
#include "tests/scenario/scripted_world/camera_robot.hpp"

namespace roci::scenario {

class Script {
 public:
  virtual ~Script() = default;
  // For the test: what it heard.
  virtual nlohmann::json heard() const = 0;
};

// Plans of images; each version is sent as a delta to the one before.
class ScriptedEngine {
 public:
  explicit ScriptedEngine(services::Node& node);

  // An image of 10 s, committed, after these others.
  temporal::PlanActivity& image(const std::string& id, const std::vector<std::string>& after);
  temporal::DecisionPoint& decision(const std::string& id, double before_s = -1);
  void send();

  temporal::FlexiblePlan plan;
  std::function<void()> on_open;  // an executive takes a plan now, and runs none

 private:
  temporal::FlexiblePlan told_;
  services::Publisher<v1::PlanDelta> deltas_;
  bool asked_ = false;
};

// ROCI_TEST_SCRIPT=NAME, with ROCI_TEST_RESOLVER for decisions.
std::unique_ptr<Script> make_script(services::Node& node, CameraRobot& robot);
std::unique_ptr<Script> make_order_script(services::Node& node, CameraRobot& robot);
std::unique_ptr<Script> make_decision_script(services::Node& node, CameraRobot& robot,
                                             const std::string& resolver);

}  // namespace roci::scenario
