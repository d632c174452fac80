// Six decisions: answered on time, twice, with an unknown choice first, too late (the engine then asks once
// more), and one that binds an argument. Whoever is to resolve them answers what it has heard by DDS.
#include <map>

#include "tests/scenario/scripted_world/script.hpp"

namespace roci::scenario {
namespace {

namespace topics = services::topics;
using namespace std::chrono_literals;
using temporal::DecisionPoint;
using temporal::ResolverKind;

class DecisionScript final : public Script {
 public:
  DecisionScript(services::Node& node, CameraRobot& robot, const std::string& resolver)
      : node_(node),
        robot_(robot),
        engine_(node),
        answers_(services::advertise(node, topics::decision_answer)),
        kind_(resolver == "engine"   ? ResolverKind::engine
              : resolver == "ground" ? ResolverKind::ground
                                     : ResolverKind::rule),
        issuer_(kind_ == ResolverKind::engine ? "scripted" : "ground") {
    engine_.on_open = [this] { plan(); };
    services::subscribe(node, topics::decision, [this](const v1::Decision& decision) { hear(decision); });
    services::subscribe(node, topics::decision_receipt, [this](const v1::DecisionReceipt& receipt) {
      receipts_[receipt.issuer() + "/" + receipt.id()] = receipt.outcome();
    });
  }

  nlohmann::json heard() const override {
    nlohmann::json questions = nlohmann::json::object();
    for (const auto& [id, state] : states_) questions[id] = static_cast<int>(state);
    nlohmann::json receipts = nlohmann::json::object();
    for (const auto& [id, outcome] : receipts_) receipts[id] = static_cast<int>(outcome);
    return {{"questions", questions}, {"receipts", receipts}};
  }

 private:
  void plan() {
    engine_.image("look", {});
    std::vector<std::string> before{"look"};
    for (const std::string number : {"1", "2", "3", "4"}) {
      engine_.image("l" + number, before);
      engine_.image("r" + number, before);
      before = {"l" + number, "r" + number};
      way("d" + number, number, number == "4" ? 100 : 1000);
    }
    engine_.image("end", before).arguments[0].value = "image-of-nothing";
    DecisionPoint& what = engine_.decision("what");
    what.resolver_kind = ResolverKind::ground;
    what.bindings = {{"end", "image"}};
    what.admissible = {"image-end", "image-other"};
    engine_.send();
    if (kind_ == ResolverKind::rule) robot_.observe("rover.way-1", "right");
  }

  DecisionPoint& way(const std::string& id, const std::string& number, double before_s) {
    DecisionPoint& decision = engine_.decision(id, before_s);
    decision.resolver_kind = kind_;
    for (const std::string side : {"left", "right"}) {
      temporal::DecisionChoice choice{side, {side.substr(0, 1) + number}};
      if (kind_ == ResolverKind::rule)
        choice.rule =
            temporal::compare("rover.way-" + number, temporal::ConditionOp::eq, temporal::state(side));
      decision.choices.push_back(choice);
    }
    return decision;
  }

  void hear(const v1::Decision& decision) {
    const bool news = !states_.contains(decision.id()) || states_[decision.id()] != decision.decision_state();
    states_[decision.id()] = decision.decision_state();
    if (!news) return;  // asked again by who took over
    if (decision.decision_state() == v1::DECISION_MISSED) return ask_again();
    if (decision.decision_state() != v1::DECISION_OPEN) return;
    const std::string id = decision.id();
    if (id == "what") answer("ground", "w", id, "", "image-end");
    if (kind_ == ResolverKind::rule) return let_rules_hold(id);
    if (id == "d1" || id == "d4b") answer(issuer_, id, id, "right");
    if (id == "d2") {
      later(5s, [this] { answer(issuer_, "d2", "d2", "right"); });
      later(6s, [this] { answer(issuer_, "d2", "d2", "left"); });
      later(7s, [this] { answer(issuer_, "d2-again", "d2", "left"); });
    }
    if (id == "d3") {
      later(1s, [this] { answer(issuer_, "d3-up", "d3", "up"); });
      later(5s, [this] { answer(issuer_, "d3", "d3", "right"); });
    }
  }

  void let_rules_hold(const std::string& id) {
    if (id == "d2") {
      later(1s, [this] { answer("ground", "d2", "d2", "left"); });
      later(5s, [this] { robot_.observe("rover.way-2", "right"); });
      later(6s, [this] { robot_.observe("rover.way-2", "left"); });
    }
    if (id == "d3") {
      later(1s, [this] { robot_.observe("rover.way-3", "up"); });
      later(5s, [this] { robot_.observe("rover.way-3", "right"); });
    }
  }

  // The fourth was not answered in time: it is too late now, and the next version of the plan asks once more.
  void ask_again() {
    later(1s, [this] {
      if (kind_ == ResolverKind::rule) {
        robot_.observe("rover.way-4", "right");
      } else {
        answer(issuer_, "d4", "d4", "right");
      }
    });
    later(2s, [this] {
      std::erase_if(engine_.plan.decisions, [](const DecisionPoint& one) { return one.id != "what"; });
      std::erase_if(engine_.plan.activities, [](const temporal::PlanActivity& one) {
        return one.id == "l1" || one.id == "l2" || one.id == "l3";  // skipped
      });
      std::erase_if(engine_.plan.constraints, [this](const temporal::TemporalConstraint& constraint) {
        const auto lost = [this](temporal::TimePoint point) {
          if (point == temporal::origin_point) return false;
          return std::ranges::none_of(engine_.plan.activities, [&](const temporal::PlanActivity& one) {
            return one.start_point == point || one.end_point == point;
          });
        };
        return lost(constraint.from_point) || lost(constraint.to_point);
      });
      way("d4b", "4", 1000);
      engine_.send();
    });
  }

  void answer(const std::string& issuer, const std::string& id, const std::string& decision,
              const std::string& choice, const std::string& value = "") {
    v1::DecisionAnswer out;
    out.issuer(issuer);
    out.id(id);
    out.decision_id(decision);
    out.choice(choice);
    out.bound_value(value);
    answers_.write(out);
  }
  void later(temporal::Duration delay, std::function<void()> what) { node_.after(delay, std::move(what)); }

  services::Node& node_;
  CameraRobot& robot_;
  ScriptedEngine engine_;
  services::Publisher<v1::DecisionAnswer> answers_;
  ResolverKind kind_;
  std::string issuer_;
  std::map<std::string, v1::DecisionState> states_;
  std::map<std::string, v1::AnswerOutcome> receipts_;
};

}  // namespace

std::unique_ptr<Script> make_decision_script(services::Node& node, CameraRobot& robot,
                                             const std::string& resolver) {
  return std::make_unique<DecisionScript>(node, robot, resolver);
}

}  // namespace roci::scenario
