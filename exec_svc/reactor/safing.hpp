/// Makes the robot safe: what runs is cancelled, components that are still active fall back (R43, R44), open
/// goals wait for the ground. That it is safe is said when it was seen, never when it was asked for.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exec_svc/archive/archive.hpp"
#include "exec_svc/reactor/mission_state.hpp"
#include "exec_svc/reactor/running_plan.hpp"

namespace roci::exec::reactor {

/// The fall-back of one component as it was commanded last.
struct SentFallback {
  std::string activity;        ///< of its key; the attempt is 1
  std::uint64_t epoch = 0;     ///< of its key
  bool answered = false;       ///< its owner has taken it, or said why not
  std::uint32_t refusals = 0;  ///< how often its owner refused the epoch
};
template <class A>
void fields(A& a, archive::Of<SentFallback, A>& v) {
  a(v.activity, v.epoch, v.answered, v.refusals);
}

class Safing {
 public:
  /// Both outlive this.
  Safing(MissionState& state, RunningPlan& plan) : state_(&state), plan_(&plan) {}

  /// Begins it. `robot.safe` is reported once every fall-back was answered, no command is being cancelled and
  /// every component was observed inactive; `robot.unsafe` says what is missing after the fall-back's time.
  void make_safe(temporal::Time now, const std::string& reason);
  /// The same for a robot that was not heard when it was to stop: nothing says that more than a pause went wrong. Once
  /// it was seen to be safe, a plan is wanted, and the ground is not waited for.
  void make_safe_unheard(temporal::Time now, const std::string& reason);

  /// Sends every component that is in an active state its fallback command, under a key of its own.
  void send_fallbacks();
  bool fallbacks_sent() const { return sent_; }
  /// No owner has said anything to the fall-backs that were sent last, or none was sent.
  bool unanswered() const;
  /// Nobody answers the fall-back of this component any more: what it needs is gone for good.
  void forget(const std::string& component) { fallbacks_.erase(component); }
  /// Those that were sent may not have been heard.
  void expect_fallbacks_again() { sent_ = false; }

  /// Takes what owners say to fall-backs. One that was refused for its epoch is sent again in the one that has
  /// begun since.
  void take(const std::vector<executive::CommandAck>& acks);
  /// Sends fall-backs behind a link again that may be lost, under their keys, one after each time in which an answer
  /// could have come: where the component is still active, and, while the robot is made safe, where no answer came.
  /// Then says whether the robot is safe. To be called once in each step, after everything else.
  void watch(temporal::Time now);
  /// After a restart.
  void resume();

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.round_, self.sent_, self.fallbacks_, self.reason_, self.awaited_, self.told_, self.safe_by_,
            self.unheard_);
  }

 private:
  void begin(temporal::Time now, const std::string& reason, const std::string& goals_wait_for);
  void send_fallback(const mission::Component&);
  void repeat_lost(temporal::Time now);
  void confirm(temporal::Time now);
  std::string missing() const;

  MissionState* state_;
  RunningPlan* plan_;
  std::uint32_t round_ = 0;  ///< part of the commands' keys: it is never reset
  bool sent_ = false;
  std::map<std::string, SentFallback> fallbacks_;  ///< of this round, by component
  std::optional<temporal::Time> repeat_at_;
  std::string reason_;                     ///< why the robot is made safe
  bool awaited_ = false;                   ///< it is not seen to be safe yet
  bool told_ = false;                      ///< operators know that it is being made safe
  std::optional<temporal::Time> safe_by_;  ///< then operators are told that it is not
  bool unheard_ = false;                   ///< nothing else was wrong: once it is seen to be safe, it goes on
};

}  // namespace roci::exec::reactor
