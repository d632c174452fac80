#include "services/node/timer_queue.hpp"

namespace roci::services::node {

TimerQueue::Id TimerQueue::add(temporal::Time due, std::function<void()> fire) {
  const Id id = next_++;
  timers_.emplace(std::pair{due, id}, std::move(fire));
  due_.emplace(id, due);
  return id;
}

void TimerQueue::cancel(Id id) {
  const auto found = due_.find(id);
  if (found == due_.end()) return;
  timers_.erase({found->second, id});
  due_.erase(found);
}

std::optional<temporal::Time> TimerQueue::earliest() const {
  if (timers_.empty()) return std::nullopt;
  return timers_.begin()->first.first;
}

void TimerQueue::run_due(temporal::Time now) {
  const Id first_new = next_;
  auto timer = timers_.begin();
  while (timer != timers_.end() && timer->first.first <= now) {
    if (timer->first.second >= first_new) {
      ++timer;
      continue;
    }
    due_.erase(timer->first.second);
    const auto fire = std::move(timers_.extract(timer).mapped());
    fire();
    timer = timers_.begin();  // the timer may have added or cancelled others
  }
}

}  // namespace roci::services::node
