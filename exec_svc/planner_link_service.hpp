// The planner link joins the executive to an engine that answers calls: a problem goes out, a verdict with a
// plan comes in.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "exec_svc/reactor/reactor.hpp"
#include "services/rpc.hpp"

namespace roci::exec {

namespace journal {
class Journal;
}

/// Makes and cancels the planner call, and measures how long and how much memory the calls took.
class PlannerLink {
 public:
  /// Calls `take` at the end of each call: with a reply, with none within the mission's time limit, with a
  /// cancellation, or with one that cannot be read (crashed). The time of the slowest call survives a restart in
  /// `journal`.
  PlannerLink(services::Node& node, const services::RunSettings& settings,
              const mission::MissionModel& mission, journal::Journal& journal,
              std::function<void(reactor::PlanReply)> take);

  /// Cancels and calls as a step has decided.
  void send(const reactor::ReactorOutputs& out);

  double slowest_call_s() const { return slowest_call_s_; }
  double peak_mib() const { return peak_kib_ / 1024.0; }

 private:
  void take(std::uint64_t call, const services::CallResult<v1::PlanReply>& result);

  const mission::MissionModel& mission_;
  journal::Journal& journal_;
  std::function<void(reactor::PlanReply)> take_;
  std::string service_;  // the one that is called
  services::Client<v1::PlanRequest, v1::PlanReply> client_;
  std::uint64_t call_ = 0;          // the last one, as the reactor numbers them
  services::rpc::CallId sent_ = 0;  // as the wire does
  double slowest_call_s_;
  std::uint32_t peak_kib_;
};

}  // namespace roci::exec
