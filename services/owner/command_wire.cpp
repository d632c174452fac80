#include "services/owner/command_wire.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "services/wire/plan_wire.hpp"

namespace roci::services::owner {
namespace {

// Of the results of one command so many are taken, with names of so many bytes; the rest counts as not measured.
constexpr std::size_t kMostValues = 64;
constexpr std::size_t kMostNameBytes = 1'024;

Action action_of(v1::CommandAction action) {
  switch (action) {
    case v1::COMMAND_CANCEL:
      return Action::cancel;
    case v1::COMMAND_QUERY:
      return Action::query;
    default:
      return Action::execute;
  }
}

v1::CommandStage stage_of(Stage stage) {
  switch (stage) {
    case Stage::accepted:
      return v1::STAGE_ACCEPTED;
    case Stage::rejected:
      return v1::STAGE_REJECTED;
    case Stage::completed:
      return v1::STAGE_COMPLETED;
    case Stage::failed:
      return v1::STAGE_FAILED;
    case Stage::cancelled:
      return v1::STAGE_CANCELLED;
    case Stage::cancel_failed:
      return v1::STAGE_CANCEL_FAILED;
    case Stage::unknown:
      break;
  }
  return v1::STAGE_UNKNOWN;
}

}  // namespace

Request from_wire(const v1::Command& command) {
  Request request;
  request.key = {command.activity(), command.attempt(), command.commander(), command.epoch()};
  request.action = action_of(command.action());
  request.epoch = command.sender_epoch();
  request.sender = command.header().sender();
  request.incarnation = command.header().incarnation();
  request.number = command.header().seq();
  request.plan = command.plan_version();
  request.robot = command.robot();
  request.subsystem = command.subsystem();
  request.command = command.command_name();
  for (const v1::Property& argument : command.arguments()) {
    request.arguments[argument.name()] = argument.value();
  }
  if (command.latest_end_us() >= 0) request.latest_end = temporal::Time(command.latest_end_us());
  return request;
}

v1::CommandResult to_wire(const Results& results) {
  v1::CommandResult out;
  out.duration_us(results.duration ? results.duration->count() : -1);
  out.energy_j(results.energy_j.value_or(std::numeric_limits<double>::quiet_NaN()));
  for (const auto& [name, value] : results.values) {
    v1::NamedValue measured;
    measured.name(name);
    measured.held(wire::to_wire(value));
    out.measured().push_back(std::move(measured));
  }
  return out;
}

v1::CommandAck to_wire(const Ack& ack, const std::string& owner) {
  v1::CommandAck out;
  out.commander(ack.key.commander);
  out.epoch(ack.key.issued_epoch);
  out.activity(ack.key.activity);
  out.attempt(ack.key.attempt);
  out.stage(stage_of(ack.status.stage));
  out.owner(owner);
  out.code(ack.status.code);
  out.reason(ack.status.reason);
  out.outcome(to_wire(ack.status.results));
  out.newest_epoch(ack.newest_epoch);
  out.refused_epoch(ack.refused_epoch);
  return out;
}

CommandStatus status_from_wire(const v1::CommandAck& ack) {
  CommandStatus status{static_cast<Stage>(std::min<std::uint32_t>(ack.stage(), v1::STAGE_UNKNOWN)),
                       ack.code(),
                       ack.reason(),
                       {}};
  const v1::CommandResult& outcome = ack.outcome();
  if (outcome.duration_us() >= 0) status.results.duration = temporal::Duration(outcome.duration_us());
  if (std::isfinite(outcome.energy_j())) status.results.energy_j = outcome.energy_j();
  for (const v1::NamedValue& measured : outcome.measured()) {
    if (status.results.values.size() >= kMostValues || measured.name().size() > kMostNameBytes) continue;
    try {
      status.results.values[measured.name()] = wire::from_wire(measured.held());
    } catch (const wire::WireError&) {  // counts as not measured
    }
  }
  return status;
}

}  // namespace roci::services::owner
