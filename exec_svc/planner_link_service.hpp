/// The line to an engine that answers calls: a problem out, a verdict with a plan in, and how long and how much
/// memory the calls took.
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

class PlannerLink {
 public:
  /// `take` gets the end of each call: a reply, none within the mission's time, a cancellation, or one that cannot be
  /// read (crashed). What the slowest call took outlives a restart in `journal`.
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
  std::string service_;  // that is called
  services::Client<v1::PlanRequest, v1::PlanReply> client_;
  std::uint64_t call_ = 0;          // the last one, as the reactor numbers them
  services::rpc::CallId sent_ = 0;  // as the wire does
  double slowest_call_s_;
  std::uint32_t peak_kib_;
};

}  // namespace roci::exec
