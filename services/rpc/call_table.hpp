// Calls of one client that are under way, without their types.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "services/node.hpp"
#include "services/rpc.hpp"
#include "services/transport.hpp"

namespace roci::services {

class CallTable {
 public:
  struct Call {
    std::string owner;
    std::function<bool(const v1::SampleIdentity&)> send;
    std::function<void(CallStatus, std::string message, const void* reply)> finish;
  };

  using SendCancel = std::function<void(const v1::SampleIdentity&, const std::string& owner)>;

  // `reachable`: request and reply topic have both matched.
  CallTable(Node&, Guid client, std::string procedure, std::function<bool()> reachable, SendCancel);

  CallId start(Call, Duration deadline);
  void cancel(CallId);
  void on_reply(const v1::ReplyHeader&, const void* reply);
  void on_peer_change(const PeerChange&);
  void on_match();

  const CallStatistics& statistics() const { return statistics_; }

 private:
  struct Pending {
    Call call;
    bool sent = false;
    bool cancelled = false;
    Duration next_wait{0};
    Node::TimerId deadline = 0;
    Node::TimerId owner_check = 0;
    Node::TimerId repetition = 0;
  };
  using Pendings = std::map<CallId, Pending>;

  bool simulated() const;
  void send(CallId number, Pending&);
  void await_repetition(CallId number, Pending&);
  void repeat(CallId number);
  void check_owner(CallId number);
  void expire(CallId number);
  void finish(Pendings::iterator, CallStatus, std::string message, const void* reply = nullptr);
  v1::SampleIdentity identity(CallId number) const;

  Node& node_;
  Guid client_;
  std::string procedure_;
  std::function<bool()> reachable_;
  SendCancel send_cancel_;
  CallId last_number_ = 0;
  Pendings pending_;
  CallStatistics statistics_;
};

}  // namespace roci::services
