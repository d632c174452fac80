#include "services/node/inbox.hpp"

#include <utility>

#include "services/bounds/limits.hpp"

namespace roci::services::node {

bool Inbox::push(Arrival arrival, std::size_t room) {
  const std::scoped_lock lock(mutex_);
  Load& load = loads_[arrival.topic];
  const std::size_t bytes = arrival.sample.payload.size();
  if (load.samples >= bounds::kInboxSamples || load.bytes + bytes > room) return false;
  ++load.samples;
  load.bytes += bytes;
  waiting_.arrivals.push_back(std::move(arrival));
  news_ = true;
  filled_.notify_one();
  return true;
}

void Inbox::push(WorkResult result) {
  const std::scoped_lock lock(mutex_);
  waiting_.results.push_back(std::move(result));
  news_ = true;
  filled_.notify_one();
}

void Inbox::matched() {
  const std::scoped_lock lock(mutex_);
  waiting_.matched = true;
  news_ = true;
  filled_.notify_one();
}

void Inbox::stop() {
  const std::scoped_lock lock(mutex_);
  waiting_.stop = true;
  news_ = true;
  filled_.notify_one();
}

// Nobody who sets the system clock moves a wait (docs/adr/0018).
static_assert(clock::WallClock::is_steady);

Inbox::Batch Inbox::take(clock::WallTime deadline) {
  std::unique_lock lock(mutex_);
  filled_.wait_until(lock, deadline, [this] { return news_; });
  news_ = false;
  Batch batch = std::exchange(waiting_, {});
  waiting_.stop = batch.stop;
  for (auto& [topic, load] : loads_) load = {};
  return batch;
}

}  // namespace roci::services::node
