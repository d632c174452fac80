#include "exec_svc/command_epoch_service.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/standby/leader_service.hpp"
#include "services/owner/command.hpp"

namespace roci::exec {

using reactor::Severity;

CommandEpoch::CommandEpoch(const services::Node& node, journal::Journal& journal, OutputPublisher& publisher,
                           Strangers& strangers, standby::LeaderService* leader, std::uint64_t epoch,
                           std::function<void(std::uint64_t)> begin)
    : node_(node),
      journal_(journal),
      publisher_(publisher),
      strangers_(strangers),
      leader_(leader),
      epoch_(epoch),
      begin_(std::move(begin)) {}

bool CommandEpoch::take_refusal(const v1::CommandAck& ack) {
  const std::uint64_t held = ack.newest_epoch();
  const bool leads = OutputPublisher::answers_epoch(ack);
  if (!leads && !publisher_.answers_command(ack)) return false;  // of an earlier leader, or of nobody
  if (held >= epoch_) {
    if (leader_ != nullptr) {
      leader_->refused(held);
    } else if (!leads) {
      follow(ack);
    }
  } else if (epoch_ - held > services::owner::kEpochJump && !publisher_.climb(ack.owner(), held)) {
    strangers_.tell("epoch.refused", ack.owner() + " holds epoch " + std::to_string(held) +
                                         ", too far before " + std::to_string(epoch_));
  }
  return !leads;
}

// Takes the epoch after the owner's, since the journal was lost or somebody else has commanded in this name. It
// is in the journal before anything goes out in it. One refusal moves it by a bounded step.
void CommandEpoch::follow(const v1::CommandAck& ack) {
  const std::uint64_t held = ack.newest_epoch();
  const std::uint64_t before = epoch_;
  epoch_ = std::min(held, epoch_ + services::owner::kEpochJump) + 1;
  journal_.set_number("epoch", static_cast<std::int64_t>(epoch_));
  publisher_.begin_epoch(epoch_);
  begin_(epoch_);
  publisher_.report({Severity::warning, "epoch.taken",
                     ack.owner() + " holds epoch " + std::to_string(held) + " of " + node_.options().name +
                         ", later than " + std::to_string(before) + "; goes on in epoch " +
                         std::to_string(epoch_)});
}

}  // namespace roci::exec
