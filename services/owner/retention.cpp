#include "services/owner/retention.hpp"

#include <algorithm>

namespace roci::services::owner {

void Retention::taken(const CommandKey& key, std::uint32_t plan) {
  IssueMark& newest = newest_[key.commander];
  newest = std::max(newest, IssueMark{key.issued_epoch, plan});
}

void Retention::ended(const CommandKey& key, std::uint32_t plan) {
  ended_.push_back({key, {key.issued_epoch, plan}});
}

std::vector<CommandKey> Retention::take_due() {
  std::vector<CommandKey> out;
  if (ended_.size() < look_again_at_) return out;
  const auto newest_kept = ended_.end() - static_cast<std::ptrdiff_t>(kKept);
  const auto due = [this](const Ended& one) { return one.mark < newest_[one.key.commander]; };
  for (auto one = ended_.begin(); one != newest_kept; ++one) {
    if (!due(*one)) continue;  // its plan may still ask for it
    IssueMark& forgotten = forgotten_[one->key.commander];
    forgotten = std::max(forgotten, one->mark);
    out.push_back(one->key);
  }
  ended_.erase(std::remove_if(ended_.begin(), newest_kept, due), newest_kept);
  look_again_at_ = 2 * std::max(ended_.size(), kKept);
  return out;
}

bool Retention::forgotten(const CommandKey& key, std::uint32_t plan) const {
  const auto mark = forgotten_.find(key.commander);
  return mark != forgotten_.end() && IssueMark{key.issued_epoch, plan} <= mark->second;
}

void Retention::restore(const std::string& commander, IssueMark mark) {
  forgotten_[commander] = std::max(forgotten_[commander], mark);
  newest_[commander] = std::max(newest_[commander], mark);
}

}  // namespace roci::services::owner
