#include "services/launch/watchdog.hpp"

#include <algorithm>

namespace roci::services::launch {

namespace {

std::string seconds_text(clock::WallDuration time) {
  return std::to_string(std::chrono::duration_cast<std::chrono::seconds>(time).count()) + " s";
}

}  // namespace

void Watchdog::started(const std::string& service, std::uint32_t incarnation, pid_t pid,
                       clock::WallTime now) {
  watched_[service] = {incarnation, pid, false, now, std::nullopt};
}

void Watchdog::kick(pid_t pid, clock::WallTime now) {
  const auto found =
      std::ranges::find_if(watched_, [pid](const auto& entry) { return entry.second.pid == pid; });
  if (found == watched_.end()) return;
  found->second.seen = now;
  found->second.ran = true;
}

void Watchdog::heard(const services::health::PeerChange& change, clock::WallTime now) {
  change.alive ? (void)heard_.insert(change.service) : (void)heard_.erase(change.service);
  const auto found = watched_.find(change.service);
  if (found == watched_.end() || found->second.incarnation != change.incarnation) return;
  const bool lost = !change.alive && (change.cause == "killed" || change.cause == "hung");
  found->second.unheard = lost ? std::optional(now) : std::nullopt;
}

bool Watchdog::ran(const std::string& service) const {
  const auto found = watched_.find(service);
  return found != watched_.end() && found->second.ran;
}

std::optional<std::string> Watchdog::reason_hung(const Watched& watched, clock::WallTime now) const {
  const auto limit = watched.ran ? limit_ : std::max(limit_, clock::wall_seconds(kStartLimitS));
  if (now - watched.seen > limit) return "hung: its loop has not turned for " + seconds_text(limit);
  // Who hears nobody is cut off itself.
  if (watched.unheard && !heard_.empty() && now - *watched.unheard > limit_)
    return "hung: its loop turns, but nobody has heard it for " + seconds_text(limit_);
  return std::nullopt;
}

void Watchdog::count_anew(clock::WallTime now) {
  for (auto& [service, watched] : watched_) {
    watched.seen = now;
    if (watched.unheard) watched.unheard = now;
  }
}

std::vector<Watchdog::Hung> Watchdog::check(clock::WallTime now) {
  std::vector<Hung> hung;
  if (limit_ == clock::WallDuration::zero()) return hung;
  if (last_check_ && now - *last_check_ > limit_ / 2) count_anew(now);
  last_check_ = now;
  for (const auto& [service, watched] : watched_) {
    if (auto why = reason_hung(watched, now)) hung.push_back({service, std::move(*why)});
  }
  for (const Hung& one : hung) watched_.erase(one.service);
  return hung;
}

}  // namespace roci::services::launch
