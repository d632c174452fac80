#include "services/vendors/inproc/writer_end.hpp"

#include <algorithm>
#include <utility>

namespace roci::services::vendors::inproc {

WriterEnd::WriterEnd(transport::EndpointDescription description, transport::WriterEvents events,
                     std::shared_ptr<Dispatcher> dispatcher, Dispatcher::Endpoint id,
                     const transport::Guid& guid)
    : description_(std::move(description)),
      events_(std::move(events)),
      dispatcher_(std::move(dispatcher)),
      id_(id),
      guid_(guid) {}

int WriterEnd::matched_readers() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(readers_.size());
}

bool WriterEnd::key_of(std::span<const std::uint8_t> payload, Key& key) const {
  if (!description_.type.keyed) return true;
  transport::Payload bytes;
  if (!description_.type.serialized_key(payload, false, bytes)) return false;
  key.assign(bytes.begin(), bytes.end());
  return true;
}

bool WriterEnd::write(std::span<const std::uint8_t> payload) {
  Key key;
  if (!key_of(payload, key)) return false;
  const std::lock_guard lock(mutex_);
  if (!send(transport::SampleKind::data, payload, key)) return false;
  if (description_.qos.transient_local) keep(key, payload);
  return true;
}

bool WriterEnd::dispose(std::span<const std::uint8_t> payload) {
  Key key;
  if (!key_of(payload, key)) return false;
  const std::lock_guard lock(mutex_);
  if (!send(transport::SampleKind::disposed, payload, key)) return false;
  forget(key);
  return true;
}

// To all readers or, when one of them has no place in time, to none.
bool WriterEnd::send(transport::SampleKind kind, std::span<const std::uint8_t> payload, const Key& key) {
  const std::chrono::milliseconds wait(description_.qos.reliable ? description_.qos.max_blocking_ms : 0);
  for (std::size_t i = 0; i < readers_.size(); ++i) {
    if (readers_[i]->reserve(wait)) continue;
    std::for_each_n(readers_.begin(), i, [](auto& reader) { reader->release(); });
    return false;
  }
  for (auto& reader : readers_)
    reader->push({kind, transport::Payload(payload.begin(), payload.end()), guid_}, key, true);
  return true;
}

void WriterEnd::keep(const Key& key, std::span<const std::uint8_t> payload) {
  history_.push_back({key, transport::Payload(payload.begin(), payload.end())});
  auto& kept = kept_of_instance_[key];
  kept.push_back(std::prev(history_.end()));
  const int depth = description_.qos.history_depth;
  if (depth > 0 && kept.size() > static_cast<std::size_t>(depth)) {
    history_.erase(kept.front());
    kept.pop_front();
  }
}

void WriterEnd::forget(const Key& key) {
  const auto kept = kept_of_instance_.find(key);
  if (kept == kept_of_instance_.end()) return;
  for (const auto& entry : kept->second) history_.erase(entry);
  kept_of_instance_.erase(kept);
}

void WriterEnd::attach(const std::shared_ptr<ReaderEnd>& reader) {
  const std::lock_guard lock(mutex_);
  readers_.push_back(reader);
  reader->attach(guid_);
  if (reader->description().qos.transient_local) {
    for (const auto& kept : history_)
      reader->push({transport::SampleKind::data, kept.payload, guid_}, kept.key, false);
  }
  if (events_.on_reader) {
    dispatcher_->post(id_,
                      [self = shared_from_this(), met = reader->guid()] { self->events_.on_reader(met); });
  }
  report_matched();
}

void WriterEnd::detach(const std::shared_ptr<ReaderEnd>& reader) {
  const std::lock_guard lock(mutex_);
  if (std::erase(readers_, reader) > 0) report_matched();
}

void WriterEnd::close() {
  {
    const std::lock_guard lock(mutex_);
    for (auto& reader : readers_) reader->detach(guid_);
    readers_.clear();
  }
  dispatcher_->remove(id_);
}

void WriterEnd::report_matched() {
  if (!events_.on_matched) return;
  dispatcher_->post(id_, [self = shared_from_this(), count = static_cast<int>(readers_.size())] {
    self->events_.on_matched(count);
  });
}

}  // namespace roci::services::vendors::inproc
