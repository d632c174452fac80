#include "services/rpc.hpp"

#include "services/bounds/limits.hpp"
#include "services/node/codec.hpp"
#include "services/node/node_impl.hpp"
#include "services/publisher.hpp"
#include "services/rpc/call_registry.hpp"

namespace roci::services::detail {

rpc::CallStatistics statistics(const rpc::PendingCalls& table) { return table.statistics(); }

void cancel(rpc::PendingCalls& table, rpc::CallId call) { table.cancel(call); }

void on_cancel(rpc::PendingReply& pending, std::function<void()> handler) {
  pending.on_cancel(std::move(handler));
}

namespace {

rpc::PendingCalls::SendCancel cancels_of(Node& node, const char* procedure) {
  return [publisher = advertise(node, topics::call_cancel), procedure](const v1::SampleIdentity& call,
                                                                       const std::string& owner) {
    v1::CallCancel cancel;
    cancel.request().request_id(call);
    cancel.request().instance_name(owner);
    cancel.procedure(procedure);
    publisher.write(std::move(cancel));
  };
}

bool is_for(const Node& node, const v1::RequestHeader& header) {
  return header.instance_name().empty() || header.instance_name() == node.options().name;
}

// All answers that a server may owe at once have gone out by then (transport/micro_step.hpp).
constexpr int kMostPostponed = 32;

// What a micro-step has no room for goes out in the next.
template <class Reply>
void send(Node& node, const Publisher<Reply>& replies, const std::shared_ptr<const void>& reply,
          int postponed = 0) {
  if (replies.write(*static_cast<const Reply*>(reply.get()))) return;
  if (!node.impl().simulated() || postponed == kMostPostponed) return;
  node.after(temporal::Duration(0),
             [&node, replies, reply, postponed] { send<Reply>(node, replies, reply, postponed + 1); });
}

// Whether the caller may ask again for what it was answered: live, from outside the run, or over a link. Else the
// barrier delivers, and nothing is kept for it.
bool may_ask_again(Node& node, const v1::SampleHeader& header) {
  return !node.impl().simulated() || header.incarnation() == 0 ||
         node.impl().links.round_trip(header.sender()).has_value();
}

rpc::ReplyCache::Id id_of(const v1::RequestHeader& header) {
  return {header.request_id().writer_guid(), header.request_id().sequence_number()};
}

}  // namespace

template <class Request, class Reply>
std::shared_ptr<rpc::PendingCalls> Calls<Request, Reply>::client(
    Node& node, const topics::Procedure<Request, Reply>& procedure) {
  auto& table = node.impl().attachment<rpc::CallRegistry>().table(procedure.request.name);
  if (table) return table;
  node::TopicWriter& requests = node.impl().endpoints.out(node::spec_of(procedure.request));
  requests.refuse_quietly();
  node::TopicReader& replies = node.impl().subscribe(node::spec_of(procedure.reply));
  table = std::make_shared<rpc::PendingCalls>(
      node.impl(), requests.guid(), procedure.request.name,
      [&requests, &replies] {
        return requests.matched_readers() > 0 && replies.reader->matched_writers() > 0;
      },
      cancels_of(node, procedure.request.name));
  subscribe(node, procedure.reply,
            [&calls = *table](const Reply& reply) { calls.on_reply(reply.reply(), &reply); });
  node.on_peer_change([&calls = *table](const health::PeerChange& change) { calls.on_peer_change(change); });
  node.impl().on_match.push_back([&calls = *table] { calls.on_match(); });
  return table;
}

template <class Request, class Reply>
rpc::CallId Calls<Request, Reply>::call(Node& node, const topics::Procedure<Request, Reply>& procedure,
                                        rpc::PendingCalls& table, Request&& request, std::string&& owner,
                                        temporal::Duration deadline, OnResult&& on_result) {
  request.request().instance_name(owner);
  rpc::PendingCalls::Call call;
  call.owner = std::move(owner);
  call.send = [publisher = advertise(node, procedure.request),
               request = std::move(request)](const v1::SampleIdentity& id) mutable {
    request.request().request_id(id);
    return publisher.write(request);
  };
  call.finish = [on_result = std::move(on_result)](rpc::CallStatus status, std::string message,
                                                   const void* reply) {
    CallResult<Reply> result{status, std::move(message), {}};
    if (reply != nullptr) result.reply = *static_cast<const Reply*>(reply);
    on_result(result);
  };
  return table.start(std::move(call), deadline);
}

template <class Request, class Reply>
void Calls<Request, Reply>::serve(Node& node, const topics::Procedure<Request, Reply>& procedure,
                                  Handler&& handler) {
  auto& server = node.impl().attachment<rpc::CallRegistry>().server(procedure.request.name);
  if (server) throw std::logic_error(node.options().name + " serves " + procedure.request.name + " twice");
  server = std::make_shared<rpc::ReplyCache>();
  node.impl().endpoints.out(node::spec_of(procedure.reply)).refuse_quietly();
  const rpc::PendingReply::Write write =
      [&node, publisher = advertise(node, procedure.reply)](const std::shared_ptr<const void>& reply) {
        send<Reply>(node, publisher, reply);
        return Reply::getCdrSerializedSize(*static_cast<const Reply*>(reply.get()));
      };
  subscribe(node, procedure.request,
            [&node, server, write, handler = std::move(handler),
             name = std::string(procedure.request.name)](const Request& request) {
              const v1::RequestHeader& header = request.request();
              if (!is_for(node, header) || !server->accept(id_of(header))) return;
              auto pending = std::make_shared<rpc::PendingReply>(server, header.request_id(), write,
                                                                 may_ask_again(node, request.header()));
              if (server->open() > bounds::kOpenRequests) {
                node.impl().rejected.note(name, node::SampleRejection::no_room);
                return Answer<Reply>::fail(
                    *pending, v1::REMOTE_EX_OUT_OF_RESOURCES,
                    std::to_string(bounds::kOpenRequests) + " requests are not answered yet");
              }
              handler(request, std::move(pending));
            });
  subscribe(node, topics::call_cancel,
            [&node, server, name = std::string(procedure.request.name)](const v1::CallCancel& cancel) {
              if (cancel.procedure() == name && is_for(node, cancel.request()))
                server->cancel(id_of(cancel.request()));
            });
}

template <class Reply>
void Answer<Reply>::reply(rpc::PendingReply& pending, Reply&& reply) {
  reply.reply().related_request_id(pending.request());
  reply.reply().remote_ex(v1::REMOTE_EX_OK);
  pending.answer(std::make_shared<const Reply>(std::move(reply)));
}

template <class Reply>
void Answer<Reply>::fail(rpc::PendingReply& pending, v1::RemoteException exception, std::string&& message) {
  Reply reply;
  reply.reply().related_request_id(pending.request());
  reply.reply().remote_ex(exception);
  reply.reply().remote_message(std::move(message));
  pending.answer(std::make_shared<const Reply>(std::move(reply)));
}

// Every procedure of topics/topics.hpp.
template struct Calls<v1::PlanRequest, v1::PlanReply>;
template struct Calls<v1::FunctionRequest, v1::FunctionReply>;
template struct Calls<v1::PathRequest, v1::PathReply>;
template struct Calls<v1::ArmMotionRequest, v1::ArmMotionReply>;
template struct Answer<v1::PlanReply>;
template struct Answer<v1::FunctionReply>;
template struct Answer<v1::PathReply>;
template struct Answer<v1::ArmMotionReply>;

}  // namespace roci::services::detail
