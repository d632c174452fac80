// The decision host answers decisions of running plans by the engine that made them (R131).
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>

#include "planner_svc/engine/decision_resolver.hpp"
#include "planner_svc/settings.hpp"
#include "roci_idl/command.h"
#include "roci_idl/order.h"
#include "services/publisher.hpp"
#include "services/worker.hpp"

namespace roci::planner {

/// Hears plans, observations and questions, and asks the resolver whenever something new could decide one. The resolver
/// looks at a question once at a time: what is heard meanwhile counts when it has ended. A
/// question that is asked again after a restart gets the same answer under the same key, which the executive takes
/// once.
class DecisionHost {
 public:
  /// `settings` must outlive this object.
  DecisionHost(services::Node& node, const Settings& settings,
               std::unique_ptr<engine::DecisionResolver> resolver);

 private:
  // A question that is open, by executive and id.
  using Key = std::pair<std::string, std::string>;
  struct Question {
    std::uint32_t plan_version = 0;
    temporal::Time answer_before = temporal::no_bound;
    std::uint64_t looked_at = 0;  // what was known then was tried; 0: never
    bool answered = false;
  };

  void hear(const v1::Decision& decision);
  void hear(const v1::Plan& plan);
  void hear(const v1::Observation& observation);
  void look_soon();
  void look();
  void look_at(const Key& key, Question& question, const temporal::FlexiblePlan& plan);
  void answer(const Key& key, Question& question, const engine::Resolution& resolution);

  services::Node& node_;
  engine::Request request_;
  std::shared_ptr<const engine::DecisionResolver> resolver_;
  services::Publisher<v1::DecisionAnswer> answers_;
  services::Publisher<v1::Event> events_;
  std::map<std::string, temporal::FlexiblePlan> plans_;  // by executive
  std::map<Key, Question> questions_;
  std::set<Key> looked_at_;  // by the worker, now or when it comes to them
  std::uint64_t known_ = 1;  // counts what was heard
  bool look_planned_ = false;
  services::Worker worker_;
};

}  // namespace roci::planner
