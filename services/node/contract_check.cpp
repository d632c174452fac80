#include "services/node/contract_check.hpp"

#include <algorithm>
#include <utility>

#include "services/bounds/limits.hpp"

namespace roci::services::node {
namespace {

// Names a participant that has no name.
std::string digits_of(const transport::Guid& guid) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < 12; ++i) {
    text += kDigits[guid[i] >> 4];
    text += kDigits[guid[i] & 15];
  }
  return text;
}

std::string or_none(const std::string& text) { return text.empty() ? "none" : text; }

}  // namespace

std::string to_text(const ContractMismatch& mismatch) {
  return "participant " + mismatch.participant + " (build " + or_none(mismatch.other_build) +
         ") has another contract for " + mismatch.topic + ": the hash of " + mismatch.type + " is " +
         or_none(mismatch.other_hash) + " there and " + or_none(mismatch.own_hash) + " here (build " +
         or_none(mismatch.own_build) +
         "); neither reads the other's samples of it: build both from the same idl/, and let participants of "
         "other make announce its contract";
}

ContractCheck::ContractCheck(std::string_view own, Lookup lookup)
    : own_(transport::parse_announcement(own).value_or(transport::Announcement{})),
      lookup_(std::move(lookup)) {}

ContractCheck::Peer* ContractCheck::find_peer(const transport::Guid& guid) {
  Prefix prefix;
  std::copy_n(guid.begin(), prefix.size(), prefix.begin());
  if (const auto known = peers_.find(prefix); known != peers_.end()) return &known->second;
  auto participant = lookup_(guid);
  if (!participant) return nullptr;
  if (peers_.size() >= bounds::kContractPeers) {
    peers_.erase(met_order_.front());
    met_order_.pop_front();
  }
  met_order_.push_back(prefix);
  Peer& peer = peers_[prefix];
  peer.name = participant->name.empty() ? digits_of(guid) : std::move(participant->name);
  peer.announced = transport::parse_announcement(participant->announcement);
  return &peer;
}

bool ContractCheck::agrees(Peer& peer, const std::string& type) const {
  if (const auto known = peer.same.find(type); known != peer.same.end()) return known->second;
  const std::string own = own_.hash_of(type);
  return peer.same[type] = !own.empty() && peer.announced && peer.announced->hash_of(type) == own;
}

ContractCheck::Agreement ContractCheck::judge(const ContractTopic& topic, const transport::Guid& remote) {
  Peer* peer = find_peer(remote);
  if (peer == nullptr) return Agreement::unknown;
  if (agrees(*peer, topic.type)) return Agreement::same;
  if (peer->told.insert(topic.name).second) {
    const transport::Announcement other = peer->announced.value_or(transport::Announcement{});
    mismatches_.push_back({topic.name, topic.type, peer->name, own_.build, own_.hash_of(topic.type),
                           other.build, other.hash_of(topic.type)});
  }
  return Agreement::different;
}

void ContractCheck::met(const ContractTopic& topic, const transport::Guid& remote) {
  const std::scoped_lock lock(mutex_);
  if (met_.size() < bounds::kUnjudgedEndpoints) met_.insert({topic, remote});
}

std::vector<ContractMismatch> ContractCheck::take_mismatches() {
  std::set<Met> fresh;
  {
    const std::scoped_lock lock(mutex_);
    fresh = std::exchange(met_, {});
  }
  for (const Met& one : fresh) {
    if (judge(one.topic, one.remote) == Agreement::unknown) met(one.topic, one.remote);
  }
  return std::exchange(mismatches_, {});
}

}  // namespace roci::services::node
