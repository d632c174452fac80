/// Makes the robot safe: what runs is cancelled, components that are still active fall back (R43, R44), open
/// goals wait for the ground.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "exec_svc/reactor/mission_state.hpp"
#include "exec_svc/reactor/running_plan.hpp"

namespace roci::exec::reactor {

class Safing {
 public:
  /// Both outlive this.
  Safing(MissionState& state, RunningPlan& plan) : state_(&state), plan_(&plan) {}

  void make_safe(temporal::Time now, const std::string& reason);

  /// Sends every component that is in an active state its fallback command, under a key of its own.
  void send_fallbacks();
  bool fallbacks_sent() const { return sent_; }
  /// Those that were sent may not have been heard.
  void expect_fallbacks_again() { sent_ = false; }
  /// Sends those again, under their keys, whose components are still active behind a link, one after each
  /// time in which an answer could have come: they may be lost.
  void repeat_lost(temporal::Time now);
  /// After a restart.
  void resume();

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.round_, self.sent_);
  }

 private:
  void send_fallback(const mission::Component&);

  MissionState* state_;
  RunningPlan* plan_;
  std::uint32_t round_ = 0;  ///< part of the commands' keys: it is never reset
  bool sent_ = false;
  std::optional<temporal::Time> repeat_at_;
};

}  // namespace roci::exec::reactor
