// The planner call is the one call to the planner: there is never more than one.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/reactor/mission_state.hpp"

namespace roci::exec::reactor {

/// Knows when the call, or its reply, no longer matches the present state, and how long to wait before the
/// next one.
class PlannerCall {
 public:
  /// The state must outlive this object.
  explicit PlannerCall(MissionState& state) : state_(&state) {}

  /// Returns the name of the next request's problem.
  std::string next_name() const;
  /// Makes the call; the request gets its id here.
  void send(PlanRequest request);
  /// Makes the call once more under another id, after a restart: nobody waits for the reply to the old one.
  void resend();
  void forget() { open_ = false; }
  /// Returns the reply to the open call, and closes the call, if it is among these inputs; else null.
  const PlanReply* take(const ReactorInputs& inputs);
  bool open() const { return open_; }
  const PlanRequest& request() const { return request_; }

  /// Notes models; ones newer than known make the open call stale. Returns those that are newer.
  std::vector<ModelVersion> note_models(const std::vector<ModelVersion>& models);
  /// Cancels the open call once it is of no use: its reply is not wanted, no goal is open, or a model has
  /// changed. After a few stale calls in a row the next one goes on all the same.
  void cancel_if_stale(bool reply_wanted);
  bool is_end_of_cancelled(const PlanReply& reply) const;
  /// Returns whether the reply is stale: a plan if a value in it stands on an older model, a verdict on the
  /// goals if any model has changed since the call.
  bool is_stale(const PlanReply& reply) const;
  /// Counts a stale reply to a call that was not cancelled, because the change came with it or too late for
  /// the cancel. Returns false if the reply counts.
  bool count_as_stale(const PlanReply& reply);
  void note_fresh() { stale_in_a_row_ = 0; }

  /// Note that a source of observations was lost, or that any service is there.
  void note_lost(const std::string& service);
  void note_found(const std::string& service) { away_.erase(service); }
  /// Gives up on the services that are away now: they make calls blind no longer.
  void forget_lost() { away_.clear(); }
  /// Returns whether a source of observations was away when the newest call was made, or has been since: what the
  /// planner proves of goals may then rest on stale observations.
  bool is_blind() const { return blind_; }
  /// Names the sources of observations that are away, in plain words; "" if all are back.
  std::string away() const;

  /// Sets the pause before the next call after one that failed for want of a service. Returns false if there
  /// were too many.
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
  std::uint64_t id_ = 0;                         ///< id of the newest call
  PlanRequest request_;                          ///< request of the newest call
  bool open_ = false;                            ///< made, and not replied to
  bool cancelled_ = false;                       ///< the newest call was cancelled
  std::map<std::string, std::uint64_t> models_;  ///< newest version by owner
  bool models_changed_ = false;                  ///< since the call was made
  std::uint32_t stale_in_a_row_ = 0;
  std::uint32_t failures_ = 0;    ///< in a row
  temporal::Time not_before_{0};  ///< earliest time of the next call
  std::set<std::string> away_;    ///< lost sources of observations
  bool blind_ = false;            ///< the newest call is blind, see is_blind()
};

}  // namespace roci::exec::reactor
