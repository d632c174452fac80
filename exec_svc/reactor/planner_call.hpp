/// The call to the planner: there is never more than one. It knows when the call, or its reply, no longer
/// speaks of what is so, and how long to wait before the next one.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/reactor/mission_state.hpp"

namespace roci::exec::reactor {

class PlannerCall {
 public:
  /// The state outlives this.
  explicit PlannerCall(MissionState& state) : state_(&state) {}

  /// The name of the next request's problem.
  std::string next_name() const;
  /// Makes the call; the request gets its id here.
  void send(PlanRequest request);
  /// Makes it once more under another id, after a restart: nobody waits for the reply to the old one.
  void resend();
  void forget() { open_ = false; }
  /// The reply to the open call, if it is among these inputs; the call is closed then.
  const PlanReply* take(const ReactorInputs& inputs);
  bool open() const { return open_; }
  const PlanRequest& request() const { return request_; }

  /// Newer models than those known make the open call stale. Returns those that are newer.
  std::vector<ModelVersion> note_models(const std::vector<ModelVersion>& models);
  /// Cancels the open call once it is of no use: its reply is not wanted, no goal is open, or a model has
  /// changed (but not again and again: after a few calls in a row one goes on).
  void cancel_if_stale(bool reply_wanted);
  bool is_end_of_cancelled(const PlanReply& reply) const;
  /// A plan is stale if a value in it stands on an older model; a verdict on the goals, if any model has
  /// changed since the call.
  bool is_stale(const PlanReply& reply) const;
  /// A stale reply to a call that was not cancelled: the change came with it, or too late for the cancel.
  /// False: the reply counts.
  bool count_as_stale(const PlanReply& reply);
  void note_fresh() { stale_in_a_row_ = 0; }

  /// A service that tells what is so was lost, or any service is there.
  void note_lost(const std::string& service);
  void note_found(const std::string& service) { away_.erase(service); }
  /// Who is away now stays away: calls are not blind for it any more.
  void forget_lost() { away_.clear(); }
  /// Whether one that tells what is so was away when the newest call was made, or has been since: then what the planner
  /// proves of goals may stand on what is not so any more.
  bool is_blind() const { return blind_; }
  /// Names those that are away, in plain words; "" if all are back.
  std::string away() const;

  /// A call failed for want of a service: sets the pause before the next one. False: there were too many.
  bool back_off(temporal::Time now);
  void clear_failures() { failures_ = 0; }
  void wait_until(temporal::Time time) { not_before_ = time; }
  temporal::Time not_before() const { return not_before_; }

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.id_, self.request_, self.open_, self.cancelled_, self.models_, self.models_changed_,
            self.stale_in_a_row_, self.failures_, self.not_before_, self.away_, self.blind_);
  }

 private:
  MissionState* state_;
  std::uint64_t id_ = 0;                         ///< of the newest call
  PlanRequest request_;                          ///< likewise
  bool open_ = false;                            ///< made, and not replied to
  bool cancelled_ = false;                       ///< the newest one was
  std::map<std::string, std::uint64_t> models_;  ///< newest version by owner
  bool models_changed_ = false;                  ///< since the call was made
  std::uint32_t stale_in_a_row_ = 0;
  std::uint32_t failures_ = 0;    ///< in a row
  temporal::Time not_before_{0};  ///< of the next call
  std::set<std::string> away_;    ///< of those that tell what is so
  bool blind_ = false;            ///< the newest call, see is_blind()
};

}  // namespace roci::exec::reactor
