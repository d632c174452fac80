#include "science_svc/watch/watch_service.hpp"

#include <fmt/format.h>

#include <utility>

#include "science_svc/watch/watch_file.hpp"
#include "services/node/make_event.hpp"
#include "services/publisher.hpp"

namespace roci::science::watch {
namespace {

namespace topics = services::topics;

v1::GoalClass on_wire(GoalClass importance) {
  switch (importance) {
    case GoalClass::hard:
      return v1::GOAL_HARD;
    case GoalClass::optional:
      return v1::GOAL_OPTIONAL;
    case GoalClass::opportunistic:
      break;
  }
  return v1::GOAL_OPPORTUNISTIC;
}

class WatchService final : public services::Service {
 public:
  WatchService(services::Node& node, std::vector<Rule> rules)
      : node_(node),
        watch_(std::move(rules)),
        goals_(services::advertise(node, topics::goal)),
        events_(services::advertise(node, topics::event)) {
    services::subscribe(node, topics::observation, [this](const v1::Observation& observation) {
      const v1::TimelineValue& value = observation.observed();
      const std::string state = value.kind() == v1::VALUE_STATE ? value.state() : "";
      for (const Wish& wish : watch_.observe(observation.timeline(), state)) raise(wish);
      if (watch_.full()) tell_full();
    });
  }

 private:
  void raise(const Wish& wish) {
    v1::Goal goal;
    goal.issuer(node_.options().name);
    goal.id(wish.id);
    goal.goal_kind(wish.goal_kind);
    for (const auto& [name, value] : wish.arguments) {
      v1::Property argument;
      argument.name(name);
      argument.value(value);
      goal.arguments().push_back(argument);
    }
    goal.importance(on_wire(wish.importance));
    goal.utility({wish.utility});
    goal.preferred_us(-1);
    goals_.write(goal);
    events_.write(services::node::make_event(
        v1::SEVERITY_INFO, "watch.goal",
        fmt::format("{} is {}: goal {} ({})", wish.timeline, wish.state, wish.id, wish.goal_kind)));
  }

  // Told once.
  void tell_full() {
    if (std::exchange(full_told_, true)) return;
    events_.write(services::node::make_event(
        v1::SEVERITY_WARNING, "watch.no_room",
        fmt::format("{} timelines are watched, those to come are not", kTimelines)));
  }

  services::Node& node_;
  Watch watch_;
  bool full_told_ = false;
  services::Publisher<v1::Goal> goals_;
  services::Publisher<v1::Event> events_;
};

}  // namespace

std::unique_ptr<services::Service> make_watch(services::Node& node, const mission::Entry& mission) {
  std::vector<Rule> rules = read_rules(mission);
  if (rules.empty()) return nullptr;
  return std::make_unique<WatchService>(node, std::move(rules));
}

}  // namespace roci::science::watch
