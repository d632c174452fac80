// The contract check compares the type hashes that a remote participant announces with our own, once per participant.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "services/transport/announcement.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::node {

/// Describes a topic on which this node and a participant do not understand each other. Hashes are empty where none is
/// announced.
struct ContractMismatch {
  std::string topic;
  std::string type;
  std::string participant;  ///< its name, or the start of its GUID in hexadecimal digits
  std::string own_build;
  std::string own_hash;
  std::string other_build;
  std::string other_hash;
};

/// Returns one sentence for people, with the remedy.
std::string to_text(const ContractMismatch&);

/// Names a topic as the contract sees it.
struct ContractTopic {
  std::string name;
  std::string type;  ///< e.g. "roci::v1::Goal"
  auto operator<=>(const ContractTopic&) const = default;
};

/// Judges participants by their announcements. Of many it remembers the newest: one that was forgotten and goes on
/// is judged, and reported, anew.
class ContractCheck {
 public:
  using Lookup = std::function<std::optional<transport::Participant>(const transport::Guid&)>;

  enum class Agreement {
    same,       ///< The participant announced our hash of the type.
    different,  ///< It announced another one, or none.
    unknown,    ///< It has not been discovered yet: ask again.
  };

  /// Compares with `own`, which this node's participant announces (announcement.hpp).
  ContractCheck(std::string_view own, Lookup);

  /// The loop's thread asks this of the writer of each sample. The first `different` of a participant and topic is a
  /// mismatch to be told.
  Agreement judge(const ContractTopic&, const transport::Guid& remote);

  /// Notes, on any thread, that a writer or reader of another participant was matched on a topic: a mismatch is
  /// reported even if no sample ever comes.
  void met(const ContractTopic&, const transport::Guid& remote);

  /// Judges what was met, and removes and returns the mismatches that are new since the last call.
  std::vector<ContractMismatch> take_mismatches();

 private:
  using Prefix = std::array<std::uint8_t, 12>;
  struct Peer {
    std::string name;
    std::optional<transport::Announcement> announced;
    std::map<std::string, bool, std::less<>> same;  // by type
    std::set<std::string> told;                     // topics
  };
  struct Met {
    ContractTopic topic;
    transport::Guid remote{};
    auto operator<=>(const Met&) const = default;
  };

  Peer* find_peer(const transport::Guid&);
  bool agrees(Peer&, const std::string& type) const;

  const transport::Announcement own_;
  const Lookup lookup_;
  std::map<Prefix, Peer> peers_;  // at most kContractPeers (bounds/limits.hpp)
  std::deque<Prefix> met_order_;  // of these, the oldest first
  std::vector<ContractMismatch> mismatches_;
  std::mutex mutex_;
  std::set<Met> met_;  // and not judged yet
};

}  // namespace roci::services::node
