#include "planner_svc/decision_host_service.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/limits.hpp"
#include "planner_svc/wire_service.hpp"
#include "services/node/make_event.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::planner {

namespace topics = services::topics;

DecisionHost::DecisionHost(services::Node& node, const Settings& settings,
                           std::unique_ptr<engine::DecisionResolver> resolver)
    : node_(node),
      resolver_(std::move(resolver)),
      answers_(services::advertise(node, topics::decision_answer)),
      events_(services::advertise(node, topics::event)),
      worker_(node) {
  request_.engine = settings.engine;
  request_.robot = node.options().robot;
  request_.model = settings.model;
  services::subscribe(node, topics::decision, [this](const v1::Decision& decision) { hear(decision); });
  services::subscribe(node, topics::plan, [this](const v1::Plan& plan) { hear(plan); });
  services::subscribe(node, topics::observation, [this](const v1::Observation& seen) { hear(seen); });
}

void DecisionHost::hear(const v1::Decision& decision) {
  const Key key{decision.executive(), decision.id()};
  if (decision.resolver() != request_.engine) return;
  if (decision.decision_state() != v1::DECISION_OPEN) {
    questions_.erase(key);
    return;
  }
  if (!questions_.contains(key) && questions_.size() >= kDecisions) return;
  Question& question = questions_[key];
  question.plan_version = decision.plan_version();
  question.answer_before =
      decision.answer_before_us() < 0 ? temporal::no_bound : temporal::Time(decision.answer_before_us());
  question.answered = false;  // asked again: the answer may be lost
  question.looked_at = 0;
  look_soon();
}

void DecisionHost::hear(const v1::Plan& plan) {
  if (plan.engine() != request_.engine) return;
  if (!plans_.contains(plan.executive()) && plans_.size() >= kOffers) return;
  try {
    plans_.insert_or_assign(plan.executive(), services::wire::from_wire(plan));
  } catch (const services::wire::WireError&) {
    return;
  }
  ++known_;
  look_soon();
}

void DecisionHost::hear(const v1::Observation& seen) {
  if (seen.timeline().size() > kNameBytes ||
      (!request_.state.contains(seen.timeline()) && request_.state.size() >= kTimelines))
    return;
  try {
    request_.state.insert_or_assign(seen.timeline(), from_wire(seen).value);
  } catch (const services::wire::WireError&) {
    return;  // the executive tells it
  }
  ++known_;
  if (!questions_.empty()) look_soon();
}

// Once for all that comes at one time.
void DecisionHost::look_soon() {
  if (std::exchange(look_planned_, true)) return;
  node_.after(temporal::Duration(0), [this] {
    look_planned_ = false;
    look();
  });
}

void DecisionHost::look() {
  for (auto& [key, question] : questions_) {
    const auto plan = plans_.find(key.first);
    if (question.answered || question.looked_at == known_ || plan == plans_.end() || looked_at_.contains(key))
      continue;
    question.looked_at = known_;
    look_at(key, question, plan->second);
  }
}

void DecisionHost::look_at(const Key& key, Question& question, const temporal::FlexiblePlan& plan) {
  const auto decision = std::ranges::find(plan.decisions, key.second, &temporal::DecisionPoint::id);
  if (decision == plan.decisions.end()) return;  // the plan that has it comes after it
  looked_at_.insert(key);
  request_.origin = node_.now();
  const std::size_t index = static_cast<std::size_t>(decision - plan.decisions.begin());
  struct Result {
    std::optional<engine::Resolution> resolution;
    std::string fault;
  };
  worker_.compute(
      [resolver = resolver_, request = request_, plan, index,
       before = question.answer_before](const std::stop_token& stop) {
        Result result;
        try {
          result.resolution = resolver->resolve({request, plan, plan.decisions[index], before, stop});
        } catch (const std::exception& error) {
          result.fault = error.what();
        }
        return result;
      },
      [this, key, version = question.plan_version](Result result) {
        looked_at_.erase(key);
        if (!result.fault.empty())
          events_.write(services::node::make_event(v1::SEVERITY_WARNING, "planner.defect",
                                                   "decision " + key.second + ": " + result.fault));
        const auto asked = questions_.find(key);
        if (asked == questions_.end() || asked->second.answered) return;
        if (result.resolution && asked->second.plan_version == version)
          answer(key, asked->second, *result.resolution);
        else if (asked->second.looked_at != known_)
          look_soon();
      });
}

void DecisionHost::answer(const Key& key, Question& question, const engine::Resolution& resolution) {
  question.answered = true;
  v1::DecisionAnswer out;
  out.issuer(request_.engine);  // who is asked
  out.id(key.first + "/" + key.second + "@" + std::to_string(question.plan_version));
  out.executive(key.first);
  out.decision_id(key.second);
  out.choice(resolution.choice);
  out.bound_value(resolution.value);
  answers_.write(std::move(out));
}

}  // namespace roci::planner
