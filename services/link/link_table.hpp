// The link table says which link joins two services of a run.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/link/link.hpp"

namespace roci::services::link {

/// Describes who sends or receives.
struct Party {
  std::string service;
  std::string robot{};  ///< empty: the team's, the ground's or the world's
  bool ground = false;  ///< a console, or the world as it sends up what a scenario says
};

/// Holds the links of a scenario, the seed of its chance, and the robot that each service belongs to. It can
/// be copied.
class LinkTable {
 public:
  struct Passage {
    const Link* link = nullptr;
    std::size_t index = 0;       ///< of the link in the table
    std::size_t sender_end = 0;  ///< 0 or 1
  };

  LinkTable() = default;
  /// Takes links, and `robots` by name of a service; one that is missing there has none.
  LinkTable(std::vector<Link> links, std::map<std::string, std::string> robots, std::uint64_t seed)
      : links_(std::move(links)), robots_(std::move(robots)), seed_(seed) {}

  bool empty() const { return links_.empty(); }
  const std::vector<Link>& links() const { return links_; }
  std::uint64_t seed() const { return seed_; }
  /// Returns whether a service belongs to a robot of that name.
  bool has_robot(const std::string& name) const;
  /// Returns the service with the robot that the mission gives it.
  Party party(const std::string& service) const;

  /// Returns the first link of the table that joins the two, or nothing if none does: what one sends then
  /// reaches the other at once. A service that hears itself needs no link.
  std::optional<Passage> passage(const Party& sender, const Party& receiver) const;
  /// Returns the round trip between the two, or nothing if no link joins them.
  std::optional<temporal::Duration> round_trip(const Party& one, const Party& other) const;
  /// Returns the services of the mission that a link joins to this one, with their round trips.
  std::map<std::string, temporal::Duration> round_trips(const Party&) const;

 private:
  std::vector<Link> links_;
  std::map<std::string, std::string> robots_;
  std::uint64_t seed_ = 1;
};

}  // namespace roci::services::link
