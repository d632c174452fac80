#include "services/node/finished_instances.hpp"

#include <utility>

namespace roci::services::node {

void FinishedInstances::written(const Key& key) {
  const auto found = known_.find(key);
  if (found == known_.end()) return;
  oldest_first_.erase(found->second);
  known_.erase(found);
}

void FinishedInstances::finished(const Key& key, transport::Payload payload) {
  written(key);
  known_[key] = oldest_first_.insert(oldest_first_.end(), Finished{key, std::move(payload), turn_});
}

std::vector<transport::Payload> FinishedInstances::take_due() {
  std::vector<transport::Payload> due;
  while (oldest_first_.size() > kept_ && oldest_first_.front().turn + rest_ <= turn_) {
    known_.erase(oldest_first_.front().key);
    due.push_back(std::move(oldest_first_.front().payload));
    oldest_first_.pop_front();
  }
  return due;
}

}  // namespace roci::services::node
