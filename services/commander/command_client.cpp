#include "services/commander/command_client.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "services/owner/command_wire.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::services::commander {

using owner::CommandStatus;
using owner::Stage;

CommandClient::CommandClient(Node& node, std::uint64_t epoch, OnIssue on_issue)
    : node_(node),
      epoch_(epoch),
      on_issue_(std::move(on_issue)),
      commands_(advertise(node, topics::command)) {
  subscribe(node, topics::command_ack, [this](const v1::CommandAck& ack) { hear(ack); });
  node.on_peer_change([this](const health::PeerChange& change) {
    if (change.alive) return;
    std::vector<Key> lost;
    for (const auto& [key, one] : under_way_)
      if (one.ours && one.call.owner == change.service) lost.push_back(key);
    for (const Key& key : lost) end(key, {Stage::failed, "owner-lost", change.service + " is lost"});
  });
}

void CommandClient::call(const Call& what, OnEnd on_end) {
  const Key key{what.activity, what.attempt};
  UnderWay& one = under_way_[key];
  one.call = what;
  one.on_end = std::move(on_end);
  issue(one);
  await(key);
}

void CommandClient::adopt(const Issued& issued, const Call& what, OnEnd on_end) {
  const Key key{what.activity, what.attempt};
  UnderWay& one = under_way_[key];
  one.call = what;
  one.issued = issued.key.issued_epoch;
  one.on_end = std::move(on_end);
  send(one, v1::COMMAND_QUERY);
  await(key);
}

void CommandClient::settle(const Issued& issued, OnEnd on_end) {
  const Key key{issued.key.activity, issued.key.attempt};
  UnderWay& one = under_way_[key];
  one.call.owner = issued.owner;
  one.call.activity = issued.key.activity;
  one.call.attempt = issued.key.attempt;
  one.issued = issued.key.issued_epoch;
  one.on_end = std::move(on_end);
  one.ours = false;
  send(one, v1::COMMAND_QUERY);
  await(key);
}

void CommandClient::cancel(const std::string& activity, std::uint32_t attempt) {
  const auto found = under_way_.find({activity, attempt});
  if (found == under_way_.end() || found->second.cancelling) return;
  found->second.cancelling = true;
  found->second.asked = 0;
  send(found->second, v1::COMMAND_CANCEL);
  await(found->first);
}

void CommandClient::issue(UnderWay& one) {
  one.issued = epoch_;
  on_issue_({{one.call.activity, one.call.attempt, node_.options().name, epoch_}, one.call.owner});
  send(one, v1::COMMAND_EXECUTE);
}

void CommandClient::send(const UnderWay& one, v1::CommandAction action) {
  v1::Command out;
  out.commander(node_.options().name);
  out.epoch(one.issued);
  out.sender_epoch(epoch_);
  out.activity(one.call.activity);
  out.attempt(one.call.attempt);
  out.action(action);
  out.owner(one.call.owner);
  out.robot(one.call.robot);
  out.subsystem(one.call.subsystem);
  out.command_name(one.call.command);
  for (const auto& [name, value] : one.call.arguments)
    out.arguments().push_back(wire::to_wire(temporal::Property{name, value}));
  out.plan_version(one.call.plan);
  out.expected_us(0);
  out.latest_end_us(wire::bound_to_wire(one.call.latest_end.value_or(temporal::no_bound)));
  commands_.write(std::move(out));
}

void CommandClient::await(const Key& key) {
  UnderWay& one = under_way_.at(key);
  if (one.timer) node_.cancel(*one.timer);
  const auto trips = node_.round_trips();
  const auto trip = trips.find(one.call.owner);
  one.timer = node_.after(trip == trips.end() ? kAnswerWithin : temporal::plus(kAnswerWithin, trip->second),
                          [this, key] { ask_again(key); });
}

void CommandClient::ask_again(const Key& key) {
  UnderWay& one = under_way_.at(key);
  one.timer.reset();
  if (++one.asked > kAsks) return end(key, {Stage::failed, "no-answer", one.call.owner + " does not answer"});
  send(one, one.cancelling ? v1::COMMAND_CANCEL : v1::COMMAND_QUERY);
  await(key);
}

void CommandClient::hear(const v1::CommandAck& ack) {
  const Key key{ack.activity(), ack.attempt()};
  const auto found = under_way_.find(key);
  if (found == under_way_.end() || ack.commander() != node_.options().name) return;
  UnderWay& one = found->second;
  if (ack.epoch() != one.issued || ack.owner() != one.call.owner) return;
  if (ack.header().sender() != one.call.owner) return;
  take(key, one, ack);
}

void CommandClient::take(const Key& key, UnderWay& one, const v1::CommandAck& ack) {
  if (ack.refused_epoch() && ack.newest_epoch() >= epoch_) {
    epoch_ = ack.newest_epoch() + 1;
    if (one.ours && !one.accepted && !one.cancelling) {
      issue(one);
    } else {
      send(one, one.cancelling ? v1::COMMAND_CANCEL : v1::COMMAND_QUERY);
    }
    return await(key);
  }
  const CommandStatus status = owner::status_from_wire(ack);
  switch (status.stage) {
    case Stage::accepted:
      one.accepted = true;
      if (one.timer && !one.cancelling) node_.cancel(*std::exchange(one.timer, std::nullopt));
      if (!one.ours) cancel(key.first, key.second);
      return;
    case Stage::cancel_failed:  // it runs on, or has ended: its last status says
      one.cancelling = false;
      one.asked = 0;
      if (one.timer) node_.cancel(*std::exchange(one.timer, std::nullopt));
      if (status.code == "already-ended") {
        send(one, v1::COMMAND_QUERY);
        await(key);
      }
      return;
    case Stage::unknown:
      if (!one.ours || one.cancelling)
        return end(key, {Stage::unknown, "unknown", "its owner never heard of it"});
      if (one.accepted) return end(key, {Stage::failed, "owner-lost", one.call.owner + " has forgotten it"});
      send(one, v1::COMMAND_EXECUTE);
      return await(key);
    default:
      return end(key, status);
  }
}

void CommandClient::end(const Key& key, CommandStatus status) {
  const auto found = under_way_.find(key);
  if (found->second.timer) node_.cancel(*found->second.timer);
  const OnEnd on_end = std::move(found->second.on_end);
  under_way_.erase(found);
  on_end(status);
}

}  // namespace roci::services::commander
