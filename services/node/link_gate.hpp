// What comes over the links of a scenario into one node: it is handled at once, later, or never.
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

/// So many lost samples are remembered by name; what is lost beyond is counted alone.
inline constexpr std::size_t kNamedLosses = 65'536;

/// The links lie between the barrier and the handlers, so that every sample has been counted by the clock
/// before it is lost or delayed. A node without links admits everything.
class LinkGate {
 public:
  /// The options outlive this.
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
  /// When take() is to be called next; empty: not before another sample comes.
  std::optional<temporal::Time> next() const;

  /// The light time to a service and back; empty if no link joins it. An empty name stands for anybody: the
  /// longest of all.
  std::optional<temporal::Duration> round_trip(const std::string& service) const;
  /// The same for every service that a link joins.
  std::map<std::string, temporal::Duration> round_trips() const;
  /// Go by name of the link.
  std::map<std::string, link::Counts> counts() const;
  /// What was lost, in the order in which it became known here.
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
