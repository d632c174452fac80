// Calls to other services: request and reply topics with the OMG DDS-RPC headers. Every call ends exactly
// once, in one of the outcomes below, at the latest at its deadline in mission time (observers: wall time).
// Late and foreign replies are dropped and counted. The table of pending calls is bounded.
//
// Live, a request is sent once both of its topics have matched and sent again, with the same id, until it is
// answered; servers handle an id once. Under the simulated clock the barrier delivers, so it is sent at once,
// once, unless a link of the scenario joins the two: then it is repeated as live, and its deadline is later by
// the light time there and back.
//
// A caller that no longer needs an answer may cancel its call: the server is told, and answers what it has.
// The call still ends with that answer, or as it would have.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "services/node.hpp"
#include "services/rpc/call_status.hpp"
#include "services/topics/topics.hpp"

namespace roci::services {

namespace rpc {
class PendingCalls;
class PendingReply;
}  // namespace rpc

/// Says how a call ended, and holds its reply.
template <class Reply>
struct CallResult {
  rpc::CallStatus status = rpc::CallStatus::timeout;
  std::string reason;  // for people, empty with CallStatus::ok
  Reply reply;         // only with CallStatus::ok
};

namespace detail {

/// Holds the typed half of calls. The members are defined and instantiated in rpc.cpp, so that users of this
/// header compile no serialization.
template <class Request, class Reply>
struct Calls {
  using OnResult = std::function<void(const CallResult<Reply>&)>;
  using Handler = std::function<void(const Request&, std::shared_ptr<rpc::PendingReply>)>;
  static std::shared_ptr<rpc::PendingCalls> client(Node&, const topics::Procedure<Request, Reply>&);
  static rpc::CallId call(Node&, const topics::Procedure<Request, Reply>&, rpc::PendingCalls&, Request&&,
                          std::string&& owner, temporal::Duration deadline, OnResult&&);
  static void serve(Node&, const topics::Procedure<Request, Reply>&, Handler&&);
};

/// Holds the typed half of answers; its members are defined in rpc.cpp, too.
template <class Reply>
struct Answer {
  static void reply(rpc::PendingReply&, Reply&&);
  static void fail(rpc::PendingReply&, v1::RemoteException, std::string&& message);
};

rpc::CallStatistics statistics(const rpc::PendingCalls&);
void cancel(rpc::PendingCalls&, rpc::CallId);
void on_cancel(rpc::PendingReply&, std::function<void()> handler);

}  // namespace detail

/// Calls one procedure of other services. It can be copied, and lives no longer than its node.
template <class Request, class Reply>
class Client {
 public:
  Client() = default;
  Client(Node& node, const topics::Procedure<Request, Reply>& procedure)
      : node_(&node), procedure_(procedure), table_(detail::Calls<Request, Reply>::client(node, procedure)) {}

  /// Begins a call. `on_result` runs on the node's loop, never inside call(). `owner` is the service that
  /// should answer, or empty for anybody. The request's header members are filled in here.
  rpc::CallId call(Request request, std::string owner, temporal::Duration deadline,
                   std::function<void(const CallResult<Reply>&)> on_result) const {
    return detail::Calls<Request, Reply>::call(*node_, procedure_, *table_, std::move(request),
                                               std::move(owner), deadline, std::move(on_result));
  }
  /// Does nothing for a call that has ended.
  void cancel(rpc::CallId call) const { detail::cancel(*table_, call); }
  rpc::CallStatistics statistics() const { return detail::statistics(*table_); }

 private:
  Node* node_ = nullptr;
  topics::Procedure<Request, Reply> procedure_{};
  std::shared_ptr<rpc::PendingCalls> table_;
};

/// Makes a client of a procedure.
template <class Request, class Reply>
Client<Request, Reply> make_client(Node& node, const topics::Procedure<Request, Reply>& procedure) {
  return {node, procedure};
}

/// Answers one request, at once or later, on the node's loop. It can be copied; the first answer counts;
/// whoever drops it without one leaves the caller to its deadline.
template <class Reply>
class Responder {
 public:
  explicit Responder(std::shared_ptr<rpc::PendingReply> pending) : pending_(std::move(pending)) {}
  void reply(Reply reply) const { detail::Answer<Reply>::reply(*pending_, std::move(reply)); }
  void fail(v1::RemoteException exception, std::string message) const {
    detail::Answer<Reply>::fail(*pending_, exception, std::move(message));
  }
  /// Sets the handler that runs once, when the caller cancels before there is an answer, or within this call
  /// if it already has. A server that sets none answers in its own time.
  void on_cancel(std::function<void()> handler) const { detail::on_cancel(*pending_, std::move(handler)); }

 private:
  std::shared_ptr<rpc::PendingReply> pending_;
};

/// Serves a procedure. A duplicate request (same id) gets the first answer again and is not handled twice. A
/// request that names another owner is left to that one. With kOpenRequests unanswered (bounds/limits.hpp)
/// the next is answered REMOTE_EX_OUT_OF_RESOURCES.
template <class Request, class Reply>
void serve(Node& node, const topics::Procedure<Request, Reply>& procedure,
           std::type_identity_t<std::function<void(const Request&, Responder<Reply>)>> handler) {
  detail::Calls<Request, Reply>::serve(
      node, procedure,
      [handler = std::move(handler)](const Request& request, std::shared_ptr<rpc::PendingReply> pending) {
        handler(request, Responder<Reply>(std::move(pending)));
      });
}

}  // namespace roci::services
