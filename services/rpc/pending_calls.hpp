// This file has the calls of one client that are under way, without their types.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/temporal/duration.hpp"
#include "roci_idl/rpc.h"
#include "services/health/peer.hpp"
#include "services/node/timer_queue.hpp"
#include "services/rpc/call_status.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::node {
class NodeImpl;
}

namespace roci::services::rpc {

/// Ends each call exactly once, with its reply or a reason.
class PendingCalls {
 public:
  struct Call {
    std::string owner;
    std::function<bool(const v1::SampleIdentity&)> send;
    std::function<void(CallStatus, std::string message, const void* reply)> finish;
  };

  using SendCancel = std::function<void(const v1::SampleIdentity&, const std::string& owner)>;

  /// Takes `reachable`, which tells whether the topics of request and reply have both matched.
  PendingCalls(node::NodeImpl&, transport::Guid client, std::string procedure,
               std::function<bool()> reachable, SendCancel);

  CallId start(Call, temporal::Duration deadline);
  void cancel(CallId);
  void on_reply(const v1::ReplyHeader&, const void* reply);
  void on_peer_change(const health::PeerChange&);
  void on_match();

  const CallStatistics& statistics() const { return statistics_; }

 private:
  struct Pending {
    Call call;
    bool sent = false;
    bool cancelled = false;
    int postponed = 0;  // to the next micro-step, since this one has no room for a further call
    temporal::Duration next_wait{0};
    /// Holds the light time to the owner and back, where a link joins it; else nothing.
    std::optional<temporal::Duration> round_trip;
    node::TimerQueue::Id deadline = 0;
    node::TimerQueue::Id owner_check = 0;
    node::TimerQueue::Id repetition = 0;
  };
  using Pendings = std::map<CallId, Pending>;

  /// Returns whether the request is repeated: live, and over a link, it may be lost on its way.
  bool repeats(const Pending&) const;
  temporal::Duration first_wait(const Pending&) const;
  void send(CallId number, Pending&);
  void await_repetition(CallId number, Pending&);
  void repeat(CallId number);
  void check_owner(CallId number);
  void expire(CallId number);
  void finish(Pendings::iterator, CallStatus, std::string message, const void* reply = nullptr);
  v1::SampleIdentity identity(CallId number) const;

  node::NodeImpl& node_;
  transport::Guid client_;
  std::string procedure_;
  std::function<bool()> reachable_;
  SendCancel send_cancel_;
  CallId last_number_ = 0;
  Pendings pending_;
  CallStatistics statistics_;
};

}  // namespace roci::services::rpc
