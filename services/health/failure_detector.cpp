#include "services/health/failure_detector.hpp"

#include <utility>

#include "services/bounds/limits.hpp"

namespace roci::services::health {

bool FailureDetector::heartbeat(const v1::Heartbeat& beat, clock::WallTime now) {
  if (peers_.size() >= bounds::kPeers && !peers_.contains(beat.service())) return false;
  Peer& peer = peers_[beat.service()];
  if (beat.state() == v1::SERVICE_STOPPING) {
    const bool leaves = peer.alive && beat.incarnation() == peer.incarnation;
    if (leaves && !peer.stopping_since) peer.stopping_since = now;
    return true;
  }
  if (!believable(peer, beat.incarnation(), now)) return true;
  if (beat.incarnation() != peer.incarnation && peer.alive) die(beat.service(), peer, "restarted");
  peer.incarnation = beat.incarnation();
  peer.last_seen = now;
  peer.stopping_since.reset();
  if (std::exchange(peer.alive, true)) return true;
  changes_.push_back({beat.service(), beat.incarnation(), true, ""});
  return true;
}

bool FailureDetector::believable(const Peer& peer, std::uint32_t incarnation, clock::WallTime now) const {
  if (incarnation == peer.incarnation || peer.incarnation == 0) return true;
  const bool next = incarnation > peer.incarnation && incarnation - peer.incarnation <= kIncarnationJump;
  const clock::WallDuration silent = now - peer.last_seen;
  if (next) return !peer.alive || silent > kStillHeard;
  return !peer.alive && silent > hang_limit_;
}

void FailureDetector::seen(const std::string& service, std::uint32_t incarnation, clock::WallTime now) {
  const auto found = peers_.find(service);
  if (found != peers_.end() && found->second.incarnation == incarnation) found->second.last_seen = now;
}

void FailureDetector::writer_lost(const std::string& service) {
  const auto found = peers_.find(service);
  if (found == peers_.end() || !found->second.alive) return;
  die(service, found->second, found->second.stopping_since ? "left" : "killed");
}

void FailureDetector::check(clock::WallTime now) {
  for (auto& [service, peer] : peers_) {
    if (!peer.alive) continue;
    if (peer.stopping_since && now - *peer.stopping_since > kStillHeard) {
      die(service, peer, "left");
    } else if (now - peer.last_seen > hang_limit_) {
      die(service, peer, "hung");
    }
  }
}

PeerState FailureDetector::state(std::string_view service) const {
  const auto found = peers_.find(service);
  if (found == peers_.end()) return PeerState::never_seen;
  return found->second.alive ? PeerState::alive : PeerState::dead;
}

std::vector<PeerChange> FailureDetector::take_changes() { return std::exchange(changes_, {}); }

void FailureDetector::die(const std::string& service, Peer& peer, std::string cause) {
  peer.alive = false;
  peer.stopping_since.reset();
  changes_.push_back({service, peer.incarnation, false, std::move(cause)});
}

}  // namespace roci::services::health
