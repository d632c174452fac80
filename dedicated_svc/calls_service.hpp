// This file carries out the calls of methods: commands, paths, transforms, observations.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "dedicated_svc/call_record_service.hpp"
#include "dedicated_svc/method_run/method_run.hpp"
#include "roci_idl/command.h"
#include "roci_idl/motion.h"
#include "services/commander/command_client.hpp"
#include "services/owner/command.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"

namespace roci::dedicated {

/// Describes a place that an object of the mission stands for, in metres.
struct Spot {
  double x = 0;
  double y = 0;
  double heading = 0;  ///< from east towards north
};
using Spots = std::map<std::string, Spot>;

/// One call at a time. Lives as long as the node's loop runs.
class Calls {
 public:
  using OnAnswer = std::function<void(const method_run::Answer&)>;

  Calls(services::Node& node, CallRecord& record, Spots objects);

  /// Begins a call that belongs to this command from above; `on_answer` runs once, on the loop, never within begin().
  void begin(const method_run::Ask& ask, const services::owner::Request& above, OnAnswer on_answer);
  /// Goes on with a call that an earlier process began then: adopts the command that is open, and begins all else
  /// again. It waits for poses that it has not heard of yet.
  void resume(const method_run::Ask& ask, const services::owner::Request& above, temporal::Time begun,
              OnAnswer on_answer);
  /// The name under which the call of this number commands: unique over the commanders from above and their epochs, and
  /// the same whenever this command is carried out again.
  static std::string activity_of(const services::owner::Request& above, std::uint32_t number);
  /// Ends the call that is under way early: its answer comes as ever, at the latest when its owner has answered.
  void break_off();
  /// Finds out what became of the command of an earlier process, ends what still runs, and then calls `settled`.
  void settle(std::function<void()> settled);

  const method_run::Observations& observed() const { return observed_; }

 private:
  void set(const method_run::Ask& ask, const services::owner::Request& above, temporal::Time begun,
           OnAnswer on_answer);
  void start(const methods::CommandCall& call);
  void start(const methods::PathCall& call);
  void start(const methods::TransformCall& call);
  void start(const methods::ObserveCall& call);
  void start(const methods::WaitCall& call);
  void look();
  void time_out();
  void answer(method_run::Answer answer);
  void answer_after(temporal::Duration wait, method_run::Answer answer);
  void answer_soon(method_run::Answer answer) { answer_after(temporal::Duration(0), std::move(answer)); }
  services::commander::Call sent_as(const methods::CommandCall& call) const;
  services::commander::CommandClient::OnEnd on_command_end();
  bool waits_for_pose(std::initializer_list<const methods::Place*> places);
  void take_path(const services::CallResult<v1::PathReply>& result);
  std::optional<Spot> spot_of(const methods::Place& place) const;
  std::optional<double> number(const std::string& timeline) const;
  void keep(const std::function<void()>& write);

  services::Node& node_;
  CallRecord& record_;
  services::Publisher<v1::Event> events_;
  Spots objects_;
  services::commander::CommandClient commands_;
  services::Client<v1::PathRequest, v1::PathReply> paths_;
  method_run::Observations observed_;

  methods::Call call_;  // under way
  services::owner::Request above_;
  std::string activity_;      // of its command
  OnAnswer on_answer_;        // empty: nothing is under way
  std::uint64_t serial_ = 0;  // counts the calls, so that a late answer is known as such
  temporal::Time begun_{};
  bool timed_out_ = false;
  bool patient_ = false;  // what was observed may still be on its way to this process
  bool lacks_pose_ = false;
  services::rpc::CallId path_{};
  std::optional<services::Node::TimerId> timer_;
};

}  // namespace roci::dedicated
