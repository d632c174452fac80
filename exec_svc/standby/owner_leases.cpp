#include "exec_svc/standby/owner_leases.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::standby {
namespace {

constexpr Moment kLongestTerm = std::chrono::seconds(60);
constexpr std::size_t kOwners = 256;  // that are heard; a mission has fewer

}  // namespace

OwnerLeases::OwnerLeases(Member self, std::set<std::string> owners, Moment patience)
    : self_(self), owners_(std::move(owners)), patience_(patience) {}

void OwnerLeases::hear(const OwnerWord& word, Moment now) {
  if (heard_.size() >= kOwners && !heard_.contains(word.owner)) return;
  Heard& heard = heard_[word.owner];
  const OwnerWord& before = heard.word;
  const bool other = word.holder && word.holder != self_;
  if (other && before.holder == word.holder && before.epoch == word.epoch && word.echo > before.echo)
    other_renewed_at_ = now;
  heard = {word, now};
  heard.word.term = std::clamp(word.term, Moment{0}, kLongestTerm);
  heard.word.echo = std::max(word.echo, Moment{0});
}

bool OwnerLeases::wants(std::optional<std::uint64_t> epoch, Moment now) {
  if (!epoch) {
    partial_since_.reset();
    silent_until_.reset();
    return false;
  }
  if (silent_until_ && now < *silent_until_) return false;
  silent_until_.reset();
  if (holds_all(*epoch, now) || !holds_any(*epoch, now)) {
    partial_since_.reset();
    return true;
  }
  if (!partial_since_) partial_since_ = now;
  if (now - *partial_since_ < patience_) return true;
  partial_since_.reset();
  silent_until_ = now + patience_ * (self_ == Member::first ? 2 : 3);
  return false;
}

bool OwnerLeases::holds(const std::string& owner, std::uint64_t epoch, Moment now) const {
  const auto heard = heard_.find(owner);
  if (heard == heard_.end()) return false;
  const OwnerWord& word = heard->second.word;
  return word.holder == self_ && word.epoch == epoch && word.echo <= now && now - word.echo < word.term;
}

bool OwnerLeases::holds_all(std::uint64_t epoch, Moment now) const {
  return std::ranges::all_of(owners_, [&](const std::string& owner) { return holds(owner, epoch, now); });
}

bool OwnerLeases::holds_any(std::uint64_t epoch, Moment now) const {
  return std::ranges::any_of(owners_, [&](const std::string& owner) { return holds(owner, epoch, now); });
}

bool OwnerLeases::hears_all(Moment within, Moment now) const {
  return std::ranges::all_of(owners_, [&](const std::string& owner) {
    const auto heard = heard_.find(owner);
    return heard != heard_.end() && now - heard->second.at <= within;
  });
}

bool OwnerLeases::other_holds_any(Moment now) const {
  return std::ranges::any_of(owners_, [&](const std::string& owner) {
    const auto heard = heard_.find(owner);
    return heard != heard_.end() && heard->second.word.holder && heard->second.word.holder != self_ &&
           now - heard->second.at < heard->second.word.term;
  });
}

std::string OwnerLeases::missing(std::uint64_t epoch, Moment now) const {
  std::string out;
  for (const std::string& owner : owners_)
    if (!holds(owner, epoch, now)) out += (out.empty() ? "" : ", ") + owner;
  return out;
}

}  // namespace roci::exec::standby
