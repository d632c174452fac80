#include "services/owner/retention.hpp"

#include <algorithm>
#include <utility>

namespace roci::services::owner {

void Retention::taken(const CommandKey& key, std::uint32_t plan) {
  IssueMark& newest = newest_[key.commander];
  newest = std::max(newest, IssueMark{key.issued_epoch, plan});
}

void Retention::ended(const CommandKey& key, std::uint32_t plan, bool counts) {
  ended_.push_back({key, {key.issued_epoch, plan}, counts});
}

void Retention::forget(const std::string& commander) {
  newest_.erase(commander);
  forgotten_.erase(commander);
}

IssueMark Retention::newest(const std::string& commander) const {
  const auto known = newest_.find(commander);
  return known == newest_.end() ? IssueMark{} : known->second;
}

std::vector<CommandKey> Retention::take_due() {
  std::vector<CommandKey> out;
  if (ended_.size() < look_again_at_) return out;
  const auto is_old = [this](const Ended& one) { return one.mark < newest(one.key.commander); };
  const auto without_plan = [&](const Ended& one) {
    const bool of_newest_plan = one.counts && one.mark.plan != 0 && one.mark == newest(one.key.commander);
    return !of_newest_plan && !is_old(one);
  };
  const auto many = static_cast<std::size_t>(std::ranges::count_if(ended_, without_plan));
  std::size_t surplus = many - std::min(many, kWithoutPlan);
  std::vector<Ended> kept;
  for (std::size_t i = 0; i < ended_.size(); ++i) {
    const Ended& one = ended_[i];
    const bool is_new = i + kKept >= ended_.size();
    if (!is_new && is_old(one)) {
      IssueMark& forgotten = forgotten_[one.key.commander];
      forgotten = std::max(forgotten, one.mark);
      out.push_back(one.key);
    } else if (!is_new && surplus > 0 && without_plan(one)) {
      --surplus;
      out.push_back(one.key);
    } else {
      kept.push_back(one);
    }
  }
  ended_ = std::move(kept);
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
