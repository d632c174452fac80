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

void OwnerLeases::hear(const LeaseReport& report, Moment now) {
  if (heard_.size() >= kOwners && !heard_.contains(report.owner)) return;
  Heard& heard = heard_[report.owner];
  const LeaseReport& before = heard.report;
  const bool other = report.holder && report.holder != self_;
  if (other && before.holder == report.holder && before.epoch == report.epoch && report.echo > before.echo)
    other_renewed_at_ = now;
  heard = {report, now};
  heard.report.term = std::clamp(report.term, Moment{0}, kLongestTerm);
  heard.report.echo = std::max(report.echo, Moment{0});
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
  const LeaseReport& report = heard->second.report;
  return report.holder == self_ && report.epoch == epoch && report.echo <= now &&
         now - report.echo < report.term;
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
    return heard != heard_.end() && heard->second.report.holder && heard->second.report.holder != self_ &&
           now - heard->second.at < heard->second.report.term;
  });
}

std::string OwnerLeases::missing(std::uint64_t epoch, Moment now) const {
  std::string out;
  for (const std::string& owner : owners_)
    if (!holds(owner, epoch, now)) out += (out.empty() ? "" : ", ") + owner;
  return out;
}

}  // namespace roci::exec::standby
