// The link gate decides whether what comes over the links of a scenario into one node is handled at once,
// later, or never.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"
#include "services/link/channel.hpp"
#include "services/link/link_table.hpp"
#include "services/node/node_options.hpp"

namespace roci::services::node {

struct TopicReader;

/// Bounds the lost samples that are remembered by name; further ones are only counted.
inline constexpr std::size_t kNamedLosses = 65'536;

/// Applies the links between the barrier and the handlers, so that the clock has counted every sample before
/// it is lost or delayed. A node without links admits everything.
class LinkGate {
 public:
  /// The options must outlive the gate.
  explicit LinkGate(const NodeOptions& options) : options_(&options) {}

  /// Takes a clocked sample. Returns true if it is to be handled now; else it is lost, or take() gives it
  /// later.
  bool admit(TopicReader&, const std::shared_ptr<const void>& value, temporal::Time now);

  struct Due {
    TopicReader* reader = nullptr;
    std::shared_ptr<const void> value;
  };
  /// Removes and returns what has arrived by now, in the order of arrival; of two that arrive at one time the
  /// link that stands first in the scenario comes first, then what was sent first.
  std::vector<Due> take(temporal::Time now);
  /// Returns when take() is to be called next, or nothing if not before another sample comes.
  std::optional<temporal::Time> next() const;

  /// Returns the light time to a service and back, or nothing if no link joins it. An empty name stands for
  /// anybody, and gives the longest of all.
  std::optional<temporal::Duration> round_trip(const std::string& service) const;
  /// Returns the same for every service that a link joins.
  std::map<std::string, temporal::Duration> round_trips() const;
  /// Returns the counts by name of the link.
  std::map<std::string, link::Counts> counts() const;
  /// Returns what was lost, in the order in which it became known here.
  const std::vector<link::LostSample>& lost() const { return lost_; }

 private:
  struct Direction {
    link::Channel channel;
    std::string name;
    std::map<std::string, TopicReader*> readers{};  // by topic
  };
  link::Party self() const;
  link::Party sender_of(const TopicReader&, const void* value) const;
  void note_losses(Direction&);

  const NodeOptions* options_;
  std::map<std::pair<std::size_t, std::size_t>, Direction> directions_;  // by link, end of the sender
  std::vector<link::LostSample> lost_;
};

}  // namespace roci::services::node
