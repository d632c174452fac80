#include "services/rpc/pending_calls.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "services/node/node_impl.hpp"

namespace roci::services::rpc {
namespace {

constexpr temporal::Duration kFirstRepetition = std::chrono::milliseconds(250);
constexpr temporal::Duration kLinkedRepetition = std::chrono::seconds(1);
constexpr temporal::Duration kLongestRepetition = std::chrono::seconds(4);
// All calls that may be under way at once have gone out by then (transport/micro_step.hpp).
constexpr int kMostPostponed = 32;

}  // namespace

PendingCalls::PendingCalls(node::NodeImpl& node, transport::Guid client, std::string procedure,
                           std::function<bool()> reachable, SendCancel send_cancel)
    : node_(node),
      client_(client),
      procedure_(std::move(procedure)),
      reachable_(std::move(reachable)),
      send_cancel_(std::move(send_cancel)) {}

v1::SampleIdentity PendingCalls::identity(CallId number) const {
  v1::SampleIdentity id;
  id.writer_guid(client_);
  id.sequence_number(number);
  return id;
}

CallId PendingCalls::start(Call call, temporal::Duration deadline) {
  if (pending_.size() >= kMaxPendingCalls) {
    node_.after(temporal::Duration(0), [finish = std::move(call.finish), name = procedure_] {
      finish(CallStatus::overloaded,
             std::to_string(kMaxPendingCalls) + " calls of " + name + " are under way", nullptr);
    });
    return ++last_number_;
  }
  const CallId number = ++last_number_;
  Pending& pending = pending_[number];
  pending.call = std::move(call);
  pending.round_trip = node_.links.round_trip(pending.call.owner);
  pending.next_wait = first_wait(pending);
  if (!pending.call.owner.empty()) {
    pending.owner_check = node_.after(temporal::Duration(0), [this, number] { check_owner(number); });
  }
  const temporal::Duration way = pending.round_trip.value_or(temporal::Duration(0));
  pending.deadline = node_.after(temporal::plus(deadline, way), [this, number] { expire(number); });
  if (node_.simulated() || reachable_()) send(number, pending);
  return number;
}

bool PendingCalls::repeats(const Pending& pending) const {
  return !node_.simulated() || pending.round_trip.has_value();
}

// Over a link no answer can come before the round trip.
temporal::Duration PendingCalls::first_wait(const Pending& pending) const {
  if (!pending.round_trip) return kFirstRepetition;
  return *pending.round_trip + (node_.simulated() ? kLinkedRepetition : kFirstRepetition);
}

// A request may be lost on its way, and so may this: both are repeated until there is an answer.
void PendingCalls::cancel(CallId number) {
  const auto found = pending_.find(number);
  if (found == pending_.end() || std::exchange(found->second.cancelled, true)) return;
  Pending& pending = found->second;
  if (pending.sent) {
    send_cancel_(identity(number), pending.call.owner);
    if (!repeats(pending)) return;
    node_.timers.cancel(pending.repetition);
    pending.next_wait = first_wait(pending);
    await_repetition(number, pending);
  } else {
    node_.timers.cancel(pending.deadline);
    pending.deadline = node_.after(temporal::Duration(0), [this, number] { expire(number); });
  }
}

void PendingCalls::send(CallId number, Pending& pending) {
  pending.sent = true;
  if (!pending.call.send(identity(number)) && node_.simulated() && pending.postponed < kMostPostponed) {
    ++pending.postponed;
    pending.repetition = node_.after(temporal::Duration(0), [this, number] { repeat(number); });
    return;
  }
  ++statistics_.sent;
  if (pending.cancelled) send_cancel_(identity(number), pending.call.owner);
  if (repeats(pending)) await_repetition(number, pending);
}

void PendingCalls::await_repetition(CallId number, Pending& pending) {
  pending.repetition = node_.after(pending.next_wait, [this, number] { repeat(number); });
  const temporal::Duration longest = std::max(first_wait(pending), kLongestRepetition);
  pending.next_wait = std::min(2 * pending.next_wait, longest);
}

void PendingCalls::repeat(CallId number) {
  const auto found = pending_.find(number);
  if (found != pending_.end()) send(number, found->second);
}

void PendingCalls::on_match() {
  if (node_.simulated() || !reachable_()) return;
  for (auto& [number, pending] : pending_) {
    if (!pending.sent && !pending.cancelled) send(number, pending);
  }
}

void PendingCalls::check_owner(CallId number) {
  const auto found = pending_.find(number);
  if (found == pending_.end()) return;
  const std::string& owner = found->second.call.owner;
  const health::PeerState state = node_.peer(owner);
  // Live, a service that nobody has seen yet may still be starting: the deadline decides.
  if (state == health::PeerState::alive || (state == health::PeerState::never_seen && !node_.simulated()))
    return;
  finish(found, CallStatus::no_owner, owner + " is not there to answer " + procedure_);
}

void PendingCalls::on_reply(const v1::ReplyHeader& header, const void* reply) {
  const v1::SampleIdentity& id = header.related_request_id();
  if (id.writer_guid() != client_) {
    ++statistics_.foreign;
    return;
  }
  const auto found = pending_.find(id.sequence_number());
  if (found == pending_.end()) {
    ++statistics_.late;
    return;
  }
  if (header.remote_ex() == v1::REMOTE_EX_OK) {
    finish(found, CallStatus::ok, "", reply);
  } else {
    finish(found, CallStatus::remote_error, header.remote_message());
  }
}

void PendingCalls::on_peer_change(const health::PeerChange& change) {
  if (change.alive) return;
  std::vector<std::int64_t> lost;
  for (const auto& [number, pending] : pending_) {
    if (pending.call.owner == change.service) lost.push_back(number);
  }
  for (const CallId number : lost) {
    const auto found = pending_.find(number);
    if (found == pending_.end()) continue;
    finish(found, CallStatus::owner_lost,
           change.service + " (" + change.cause + ") while it answered " + procedure_);
  }
}

void PendingCalls::expire(CallId number) {
  const auto found = pending_.find(number);
  if (found == pending_.end()) return;
  const std::string& owner = found->second.call.owner;
  if (!found->second.sent && found->second.cancelled) {
    finish(found, CallStatus::cancelled, procedure_ + " was cancelled before it was sent");
  } else if (!found->second.sent) {
    finish(found, CallStatus::no_owner, "nobody serves " + procedure_);
  } else if (!owner.empty() && node_.peer(owner) != health::PeerState::alive) {
    finish(found, CallStatus::no_owner, owner + " never appeared to answer " + procedure_);
  } else {
    finish(found, CallStatus::timeout, "no answer to " + procedure_ + " before the deadline");
  }
}

void PendingCalls::finish(Pendings::iterator found, CallStatus status, std::string message,
                          const void* reply) {
  const Pending ended = std::move(pending_.extract(found).mapped());
  node_.timers.cancel(ended.deadline);
  node_.timers.cancel(ended.owner_check);
  node_.timers.cancel(ended.repetition);
  ended.call.finish(status, std::move(message), reply);
}

}  // namespace roci::services::rpc
