#include "services/link/link_table.hpp"

#include <algorithm>

#include "services/link/channel.hpp"

namespace roci::services::link {
namespace {

bool is_at(const Party& party, const std::string& end) {
  return party.service == end || party.robot == end || (party.ground && end == kGround);
}

}  // namespace

Party LinkTable::party(const std::string& service) const {
  const auto robot = robots_.find(service);
  return {service, robot == robots_.end() ? "" : robot->second};
}

bool LinkTable::has_robot(const std::string& name) const {
  return !name.empty() && std::ranges::any_of(robots_, [&](const auto& one) { return one.second == name; });
}

std::optional<LinkTable::Passage> LinkTable::passage(const Party& sender, const Party& receiver) const {
  if (sender.service == receiver.service) return std::nullopt;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    for (const std::size_t end : {0U, 1U}) {
      if (is_at(sender, links_[i].ends[end]) && is_at(receiver, links_[i].ends[1 - end]))
        return Passage{&links_[i], i, end};
    }
  }
  return std::nullopt;
}

std::optional<temporal::Duration> LinkTable::round_trip(const Party& one, const Party& other) const {
  const auto found = passage(one, other);
  return found ? std::optional(link::round_trip(*found->link)) : std::nullopt;
}

std::map<std::string, temporal::Duration> LinkTable::round_trips(const Party& one) const {
  std::map<std::string, temporal::Duration> out;
  for (const auto& [service, robot] : robots_) {
    if (const auto time = round_trip(one, {service, robot})) out[service] = *time;
  }
  return out;
}

}  // namespace roci::services::link
