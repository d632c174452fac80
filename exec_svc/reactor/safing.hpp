// Safing makes the robot safe. That it is safe is reported when it was observed, never when it was asked for.
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

/// Holds the fall-back of one component as it was commanded last.
struct SentFallback {
  std::string activity;        ///< part of its key; the attempt is 1
  std::uint64_t epoch = 0;     ///< part of its key
  bool answered = false;       ///< its owner has taken it, or said why not
  std::uint32_t refusals = 0;  ///< how often its owner refused the epoch
};
template <class A>
void fields(A& a, archive::Of<SentFallback, A>& v) {
  a(v.activity, v.epoch, v.answered, v.refusals);
}

/// Cancels what runs, sends the components that are still active their fallback commands (R43, R44), and
/// reports when the robot is safe, or that it is not. Open goals wait for the ground.
class Safing {
 public:
  /// Both arguments must outlive this object.
  Safing(MissionState& state, RunningPlan& plan) : state_(&state), plan_(&plan) {}

  /// Begins to make the robot safe. `robot.safe` is reported once every fall-back was answered, no command is
  /// being cancelled and every component was observed inactive; `robot.unsafe` says what is missing after the
  /// fall-back's time.
  void make_safe(temporal::Time now, const std::string& reason);
  /// Does the same for a robot that was not heard when it was to stop, as over a broken link. Once it was observed to
  /// be safe a plan is wanted, and the ground is not waited for.
  void make_safe_unheard(temporal::Time now, const std::string& reason);
  /// Makes a robot safe once more that was made safe: what is active still, or again, gets another fall-back, but where
  /// an answer to the newest one is awaited.
  void make_safe_again(temporal::Time now, const std::string& reason);

  /// Sends every component that is in an active state its fallback command, under a key of its own.
  void send_fallbacks();
  bool fallbacks_sent() const { return sent_; }
  /// Returns whether no owner has answered the fall-backs that were sent last, or none was sent.
  bool unanswered() const;
  /// Nobody answers the fall-back of this component any more: what it needs is gone for good.
  void forget(const std::string& component) { fallbacks_.erase(component); }
  /// Those that were sent may not have been heard.
  void expect_fallbacks_again() { sent_ = false; }

  /// Takes owners' answers to fall-backs. One that was refused for its epoch is sent again in the epoch that
  /// has begun since.
  void take(const std::vector<executive::CommandAck>& acks);
  /// Repeats fall-backs that a link may have lost, under their keys, each time an answer could have come: where the
  /// component is still active and, while the robot is made safe, where no answer came. Then reports whether the
  /// robot is safe. It is to be called once in each step, after everything else.
  void watch(temporal::Time now);
  /// Goes on after a restart.
  void resume();

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.round_, self.sent_, self.fallbacks_, self.reason_, self.awaited_, self.told_, self.safe_by_,
            self.unheard_);
  }

 private:
  void begin(temporal::Time now, const std::string& reason, const std::string& goals_wait_for);
  void await(temporal::Time now, const std::string& reason);
  void send_fallback(const mission::Component&);
  void repeat_lost(temporal::Time now);
  void confirm(temporal::Time now);
  std::string missing() const;

  MissionState* state_;
  RunningPlan* plan_;
  std::uint32_t round_ = 0;  ///< part of the commands' keys: it is never reset
  bool sent_ = false;
  std::map<std::string, SentFallback> fallbacks_;  ///< those of this round, by component
  std::optional<temporal::Time> repeat_at_;
  std::string reason_;                     ///< why the robot is made safe
  bool awaited_ = false;                   ///< the robot is not observed to be safe yet
  bool told_ = false;                      ///< operators know that the robot is being made safe
  std::optional<temporal::Time> safe_by_;  ///< operators are told then that it is not safe
  bool unheard_ = false;  ///< nothing else was wrong: it goes on once it is observed to be safe
};

}  // namespace roci::exec::reactor
