#include "services/node/inbox.hpp"

#include <utility>

namespace roci::services::node {

void Inbox::push(Arrival arrival) {
  const std::scoped_lock lock(mutex_);
  waiting_.arrivals.push_back(std::move(arrival));
  news_ = true;
  filled_.notify_one();
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

Inbox::Batch Inbox::take(clock::WallTime deadline) {
  std::unique_lock lock(mutex_);
  filled_.wait_until(lock, deadline, [this] { return news_; });
  news_ = false;
  Batch batch = std::exchange(waiting_, {});
  waiting_.stop = batch.stop;
  return batch;
}

}  // namespace roci::services::node
