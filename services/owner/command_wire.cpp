#include "services/owner/command_wire.hpp"

namespace roci::services::owner {
namespace {

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
      return v1::COMMAND_ACCEPTED;
    case Stage::rejected:
      return v1::COMMAND_REJECTED;
    case Stage::completed:
      return v1::COMMAND_COMPLETED;
    case Stage::failed:
      return v1::COMMAND_FAILED;
    case Stage::cancelled:
      return v1::COMMAND_CANCELLED;
    case Stage::cancel_failed:
      return v1::COMMAND_CANCEL_FAILED;
    case Stage::unknown:
      break;
  }
  return v1::COMMAND_UNKNOWN;
}

}  // namespace

Request from_wire(const v1::Command& command) {
  Request request;
  request.key = {command.activity(), command.attempt(), "", 0};
  request.action = action_of(command.action());
  request.epoch = command.epoch();
  request.subsystem = command.subsystem();
  request.command = command.command_name();
  for (const v1::Property& argument : command.arguments()) {
    request.arguments[argument.name()] = argument.value();
  }
  return request;
}

v1::CommandAck to_wire(const Ack& ack, const std::string& owner) {
  v1::CommandAck out;
  out.activity(ack.key.activity);
  out.attempt(ack.key.attempt);
  out.stage(stage_of(ack.word.stage));
  out.owner(owner);
  out.code(ack.word.code);
  out.reason(ack.word.reason);
  out.refused_epoch(ack.refused_epoch);
  return out;
}

}  // namespace roci::services::owner
