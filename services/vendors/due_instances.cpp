#include "services/vendors/due_instances.hpp"

#include <algorithm>
#include <utility>

namespace roci::services::vendors {

void DueInstances::changed(const Key& key) {
  due_.erase(key);
  if (!leaves_older_changes()) return;
  if (kept_ && kept_->key == key) kept_.reset();
  int& count = changes_[key];
  count = std::min(count + 1, depth_ - 1);
}

bool DueInstances::forget(Instance instance) {
  if (kept_ && kept_->key == instance.key) return false;
  if (leaves_older_changes() && !kept_) {
    kept_ = std::move(instance);
    return false;
  }
  if (due_.insert(instance.key).second) waiting_.push_back(std::move(instance));
  return true;
}

DueInstances::Group DueInstances::take() {
  Group group;
  for (Instance& due : std::exchange(waiting_, {})) {
    if (due_.erase(due.key) == 0) continue;
    if (leaves_older_changes() && !kept_) {
      group.kept = kept_ = std::move(due);
      group.times = 1;
    } else {
      group.unregistered.push_back(std::move(due));
    }
  }
  int most = 0;
  for (const Instance& due : group.unregistered) {
    const auto found = changes_.find(due.key);
    if (found == changes_.end()) continue;
    most = std::max(most, found->second);
    changes_.erase(found);
  }
  if (group.unregistered.size() < 2) return group;
  group.kept = kept_;
  group.times = std::max(group.times, most);
  return group;
}

}  // namespace roci::services::vendors
