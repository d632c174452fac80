// A ground that gives every kind of order to a plan of seven images, some twice, some that must be refused.
#include <map>

#include "core/bytes/crc_32.hpp"
#include "tests/scenario/scripted_world/script.hpp"

namespace roci::scenario {
namespace {

namespace topics = services::topics;
using namespace std::chrono_literals;

class OrderScript final : public Script {
 public:
  OrderScript(services::Node& node, CameraRobot& robot)
      : node_(node), robot_(robot), engine_(node), orders_(services::advertise(node, topics::order)) {
    engine_.on_open = [this] { plan(); };
    services::subscribe(node, topics::order_status, [this](const v1::OrderStatus& status) {
      last_[status.id()] = {{"stage", static_cast<int>(status.stage())},
                            {"reason", status.reason()},
                            {"plan", status.plan_version()}};
    });
    services::subscribe(node, topics::observation, [this](const v1::Observation& seen) {
      if (seen.timeline() == "rover.go") go_seen_ = seen.observed().truth();
    });
    services::subscribe(node, topics::mission_status, [this](const v1::MissionStatus& status) {
      if (status.held()) held_seen_ = true;
    });
    give();
  }

  nlohmann::json heard() const override {
    return {{"orders", last_}, {"go", go_seen_}, {"held", held_seen_}};
  }

 private:
  void plan() {
    std::vector<std::string> before;
    for (const char* id : {"look", "a", "b", "c", "d", "e", "end"}) {
      engine_.image(id, before);
      before = {id};
    }
    auto& activities = engine_.plan.activities;
    activities[3].pre = temporal::compare("rover.go", temporal::ConditionOp::eq, true);
    activities[6].arguments[0].value = "image-of-nothing";
    temporal::DecisionPoint& what = engine_.decision("what");
    what.resolver_kind = temporal::ResolverKind::ground;
    what.bindings = {{"end", "image"}};
    engine_.send();
    robot_.break_shutter_for("image-e");
  }

  void give() {
    at(3s, "hold", v1::ORDER_HOLD);
    v1::Order other = order("for-another", v1::ORDER_HOLD);
    other.robot("another");
    at(4s, other);
    at(5s, "hold", v1::ORDER_HOLD);  // once more: it is answered, and given once
    at(20s, "release", v1::ORDER_RELEASE);
    at(22s, "e1", v1::AUTONOMY_E1);
    at(35s, "approve", v1::ORDER_APPROVE, "b");
    at(46s, "e2", v1::AUTONOMY_E2);
    v1::Order go = order("go", v1::ORDER_SET_VALUE, "rover.go");
    go.content().kind(v1::VALUE_BOOLEAN);
    go.content().truth(true);
    at(50s, go);
    at(51s, "drop", v1::ORDER_DROP, "d");
    upload(52s, "upload", 0);
    upload(53s, "garbled", 1);
    at(75s, "refused", v1::ORDER_HOLD, "nothing");
    at(80s, "relaunch", v1::ORDER_RELAUNCH);
    v1::Order answer = order("answer", v1::ORDER_ANSWER, "what");
    answer.content().kind(v1::VALUE_STATE);
    answer.content().state("image-end");
    at(95s, answer);
    at(97s, "safe", v1::ORDER_SAFE);
    at(110s, "relaunch-2", v1::ORDER_RELAUNCH);
  }

  static v1::Order order(const std::string& id, v1::OrderKind kind, const std::string& target = "") {
    v1::Order out;
    out.issuer("ground");
    out.id(id);
    out.order_kind(kind);
    out.target(target);
    out.autonomy(v1::AUTONOMY_E4);
    return out;
  }
  void at(temporal::Time when, const v1::Order& order) {
    node_.at(when, [this, order] { orders_.write(order); });
  }
  void at(temporal::Time when, const std::string& id, v1::OrderKind kind, const std::string& target = "") {
    at(when, order(id, kind, target));
  }
  void at(temporal::Time when, const std::string& id, v1::AutonomyLevel level) {
    v1::Order out = order(id, v1::ORDER_AUTONOMY);
    out.autonomy(level);
    at(when, out);
  }
  void upload(temporal::Time when, const std::string& id, std::uint32_t wrong_by) {
    const std::string text = "commands: [{owner: sim_svc, component: camera, command: stop}]\n";
    v1::Order out = order(id, v1::ORDER_UPLOAD, "contingencies.wipe");
    out.upload().assign(text.begin(), text.end());
    out.checksum(bytes::crc_32(text) + wrong_by);
    at(when, out);
  }

  services::Node& node_;
  CameraRobot& robot_;
  ScriptedEngine engine_;
  services::Publisher<v1::Order> orders_;
  std::map<std::string, nlohmann::json> last_;  // stage of each order, as it was heard last
  bool go_seen_ = false;
  bool held_seen_ = false;
};

}  // namespace

std::unique_ptr<Script> make_order_script(services::Node& node, CameraRobot& robot) {
  return std::make_unique<OrderScript>(node, robot);
}

}  // namespace roci::scenario
