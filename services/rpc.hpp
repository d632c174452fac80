// Calls to other services: request and reply topics with the OMG DDS-RPC headers. Every call ends exactly once, in
// one of the outcomes below, at the latest at its deadline in mission time. Late and foreign replies are dropped and
// counted. The table of pending calls is bounded (max_pending; the next call ends at once in `overloaded`).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "services/node.hpp"

namespace roci::services {

enum class CallStatus { ok, timeout, no_owner, owner_lost, remote_error, overloaded };

template <class Reply>
struct CallResult {
  CallStatus status = CallStatus::timeout;
  std::string message;
  Reply reply;  // only with CallStatus::ok
};

template <class Request, class Reply>
class Client {
 public:
  // `on_result` runs on the node's loop. `owner`: the service that should answer; no_owner or owner_lost when it is
  // not there or dies; empty: anybody.
  void call(Request, std::string owner, Duration deadline, std::function<void(const CallResult<Reply>&)> on_result);
};

template <class Request, class Reply>
Client<Request, Reply> make_client(Node&, const topics::Procedure<Request, Reply>&);

// Answers later or at once, once. Copyable; dropping it without an answer leaves the caller to its deadline.
template <class Reply>
class Responder {
 public:
  void reply(Reply) const;
  void fail(v1::RemoteException, std::string message) const;
};

// A duplicate request (same id) gets the first answer again and is not handled twice.
template <class Request, class Reply>
void serve(Node&, const topics::Procedure<Request, Reply>&,
           std::function<void(const Request&, Responder<Reply>)> handler);

}  // namespace roci::services
