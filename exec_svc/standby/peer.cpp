#include "exec_svc/standby/peer.hpp"

namespace roci::exec::standby {

using journal::Position;

namespace {

constexpr std::uint64_t kNear = 64;  // batches; so close a follower is waited for

}  // namespace

std::optional<Moment> Peer::sent_since() const {
  if (!heard_ || heard_->message.echo < started_ || heard_->message.echo > heard_->at) return std::nullopt;
  return heard_->message.echo;
}

bool Peer::has(const Position& position, std::uint64_t epoch) const {
  if (!heard_ || heard_->message.role != Role::following) return false;
  const Position& has = heard_->message.has;
  return has == position || (has.epoch == epoch && has.sequence >= position.sequence);
}

bool Peer::is_near(const Position& newest, std::uint64_t epoch) const {
  if (has(newest, epoch)) return true;
  const Position& has = heard_->message.has;
  return heard_->message.role == Role::following && has.epoch == epoch &&
         newest.sequence - has.sequence <= kNear;
}

}  // namespace roci::exec::standby
