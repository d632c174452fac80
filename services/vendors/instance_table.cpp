#include "services/vendors/instance_table.hpp"

#include <algorithm>
#include <utility>

namespace roci::services::vendors {

transport::Payload key_only_payload(std::span<const std::uint8_t> serialized_key) {
  transport::Payload payload(4 + serialized_key.size());
  std::copy(serialized_key.begin(), serialized_key.end(), payload.begin() + 4);
  return payload;
}

bool InstanceTable::wrote(const Key& key, const transport::Guid& writer) {
  const auto found = alive_.find(key);
  if (found == alive_.end()) return false;
  auto& writers = found->second.writers;
  const bool known = std::find(writers.begin(), writers.end(), writer) != writers.end();
  if (!known && writers.size() < kWriters) writers.push_back(writer);
  return true;
}

bool InstanceTable::introduce(const Key& key, const transport::Guid& writer, transport::Payload key_payload) {
  if (alive_.size() >= kInstances && !alive_.contains(key)) return false;
  alive_[key] = {std::move(key_payload), {writer}};
  return true;
}

std::optional<transport::Payload> InstanceTable::ended(const Key& key) {
  auto node = alive_.extract(key);
  if (node.empty()) return std::nullopt;
  return std::move(node.mapped().key_payload);
}

std::vector<InstanceTable::Orphan> InstanceTable::writer_left(const transport::Guid& writer) {
  std::vector<Orphan> orphans;
  for (auto it = alive_.begin(); it != alive_.end();) {
    auto& instance = it->second;
    if (std::erase(instance.writers, writer) > 0 && instance.writers.empty()) {
      orphans.push_back({it->first, std::move(instance.key_payload)});
      it = alive_.erase(it);
    } else {
      ++it;
    }
  }
  return orphans;
}

std::vector<InstanceTable::Key> InstanceTable::keys() const {
  std::vector<Key> keys;
  for (const auto& [key, instance] : alive_) keys.push_back(key);
  return keys;
}

}  // namespace roci::services::vendors
