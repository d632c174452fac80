#include "services/health/namesake_watch.hpp"

#include <tuple>

namespace roci::services::health {
namespace {

// A namesake that was silent for so long is heard anew.
constexpr clock::WallDuration kForgotten = std::chrono::seconds(5);

}  // namespace

NamesakeWatch::Precedence NamesakeWatch::hear(const v1::Heartbeat& beat, clock::WallTime now) {
  const bool own = beat.host() == self_.host() && beat.process_id() == self_.process_id();
  if (beat.service() != self_.service() || own || beat.state() == v1::SERVICE_STOPPING)
    return Precedence::nothing;
  std::erase_if(namesakes_, [&](const auto& one) { return now - one.second.last > kForgotten; });
  const std::pair key(beat.host(), beat.process_id());
  if (namesakes_.size() >= kMost && !namesakes_.contains(key)) return Precedence::nothing;
  Namesake& other = namesakes_.try_emplace(key, Namesake{now, now}).first->second;
  other.last = now;
  if (++other.beats < kBeats || now - other.first < kHeardFor) return Precedence::nothing;
  if (wins(beat)) return Precedence::yields;
  if (std::exchange(other.told, true)) return Precedence::nothing;
  return Precedence::goes_on;
}

bool NamesakeWatch::wins(const v1::Heartbeat& other) const {
  if (other.incarnation() > self_.incarnation())
    return other.incarnation() - self_.incarnation() <= kIncarnationJump;
  if (other.incarnation() < self_.incarnation()) return false;
  return std::tuple(other.host(), other.process_id()) < std::tuple(self_.host(), self_.process_id());
}

std::string process_text(const v1::Heartbeat& beat) {
  return beat.service() + " on " + beat.host() + ", process " + std::to_string(beat.process_id());
}

}  // namespace roci::services::health
