// A world that answers an executive by a script, and writes down what happened.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "exec_svc/executive/executive.hpp"

namespace roci::exec::testing {

// Words that scripts are written in.
using temporal::compare;
using temporal::ConditionOp;
using temporal::PlanActivity;
using temporal::seconds;
using temporal::state;

/// How an owner answers one attempt of a command. Times in seconds.
struct Answer {
  bool accepts = true;
  double lasts = -1;  ///< until the end; negative: as long as the command expects
  executive::CommandStage ends_with = executive::CommandStage::completed;
  std::string reason{};
  bool answers_cancel = true;
};

/// Answers come by the way: accepted at once, the end when it has lasted. Runs the executive from wake to
/// wake.
class ScriptedWorld {
 public:
  explicit ScriptedWorld(temporal::FlexiblePlan plan, executive::ExecutiveSettings settings = {});

  /// Answers of an activity's attempts in their order; the last one stands for all further ones.
  void answers(const std::string& activity, std::vector<Answer> answers) {
    answers_[activity] = std::move(answers);
  }
  void at(double seconds, executive::Inputs inputs);
  void observe(double seconds, const std::string& timeline, temporal::Value value);
  void cancel_at(double seconds);
  void load_at(double seconds, temporal::FlexiblePlan plan);

  /// Until nothing more can happen, or the plan has ended, or `until` has passed. Returns the trace.
  const std::vector<std::string>& run(double until = 1e6);

  executive::Executive executive;
  std::vector<std::string> trace;
  std::vector<std::string> recoveries;           ///< "30 retry drive: cause"
  std::map<std::string, std::string> arguments;  ///< first argument of each command, by activity

 private:
  struct Event {
    executive::Inputs inputs{};
    std::function<executive::Outputs(temporal::Time)> act{};
  };

  void note(const executive::Outputs& outputs);
  void answer(const executive::Command& command);

  std::map<std::string, std::vector<Answer>> answers_;
  std::multimap<temporal::Time, Event> events_;
  std::map<std::string, std::multimap<temporal::Time, Event>::iterator> ends_;  // of commands that run
  temporal::Time now_{0};
  executive::OutcomeKind outcome_ = executive::OutcomeKind::running;
};

}  // namespace roci::exec::testing
