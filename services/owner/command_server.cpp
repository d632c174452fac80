#include "services/owner/command_server.hpp"

#include <utility>

#include "services/owner/command_wire.hpp"

namespace roci::services::owner {

CommandServer::CommandServer(Node& node, Driver& driver)
    : node_(node), driver_(driver), acks_(advertise(node, topics::command_ack)) {
  subscribe(node, topics::command, [this](const v1::Command& command) {
    if (command.owner() == node_.options().name) receive(from_wire(command));
  });
}

void CommandServer::receive(const Request& request) {
  driver_.catch_up();
  const Reception reception = ledger_.receive(request, node_.now());
  send(reception.ack);
  switch (reception.order) {
    case Reception::Order::nothing:
      return;
    case Reception::Order::break_off:
      return driver_.break_off(request.key, {Stage::cancelled, "cancelled", "cancelled on request"});
    case Reception::Order::carry_out:
      break;
  }
  if (request.command == kStopCommand && !driver_stops_) return stop(request);
  driver_.carry_out(request);
}

void CommandServer::stop(const Request& request) {
  for (const CommandKey& key : ledger_.open(request.robot, request.subsystem)) {
    if (key == request.key) continue;
    driver_.break_off(key, {Stage::cancelled, "stopped", "stopped by " + request.key.activity});
  }
  say(request.key, {Stage::completed, "done", ""});
}

bool CommandServer::say(const CommandKey& key, Word word) {
  return send(ledger_.say(key, std::move(word), node_.now()));
}

bool CommandServer::refuse_cancel(const CommandKey& key, std::string reason) {
  return send(ledger_.refuse_cancel(key, std::move(reason), node_.now()));
}

bool CommandServer::repair(const CommandKey& key, std::string reason) {
  const bool allowed = send(ledger_.repair(key, std::move(reason), node_.now()));
  watch_overruns();
  return allowed;
}

bool CommandServer::send(const std::optional<Ack>& ack) {
  if (ack) acks_.write(to_wire(*ack, node_.options().name));
  return ack.has_value();
}

void CommandServer::watch_overruns() {
  if (overrun_) node_.cancel(*std::exchange(overrun_, std::nullopt));
  const auto next = ledger_.next_overrun();
  if (!next) return;
  overrun_ = node_.at(*next, [this] {
    overrun_.reset();
    for (const CommandKey& key : ledger_.take_overruns(node_.now())) {
      const Word why{Stage::failed, "repair-overrun", "the step's time was over before the repair was"};
      driver_.break_off(key, why);
    }
    watch_overruns();
  });
}

}  // namespace roci::services::owner
