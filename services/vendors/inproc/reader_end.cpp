#include "services/vendors/inproc/reader_end.hpp"

#include <algorithm>
#include <utility>

namespace roci::services::vendors::inproc {

ReaderEnd::ReaderEnd(transport::EndpointDescription description, transport::ReaderEvents events,
                     std::shared_ptr<Dispatcher> dispatcher, Dispatcher::Endpoint id,
                     const transport::Guid& guid)
    : description_(std::move(description)),
      events_(std::move(events)),
      dispatcher_(std::move(dispatcher)),
      id_(id),
      guid_(guid) {}

int ReaderEnd::matched_writers() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(writers_.size());
}

bool ReaderEnd::limited() const {
  return description_.qos.reliable && description_.qos.history_depth == 0 && description_.qos.max_samples > 0;
}

bool ReaderEnd::reserve(std::chrono::milliseconds max_wait) {
  std::unique_lock lock(mutex_);
  const auto free = [this] { return closed_ || !limited() || samples_ < description_.qos.max_samples; };
  if (!space_.wait_for(lock, max_wait, free)) return false;
  ++samples_;
  return true;
}

void ReaderEnd::release() {
  const std::lock_guard lock(mutex_);
  --samples_;
  space_.notify_one();
}

void ReaderEnd::push(transport::Sample sample, const Key& key, bool reserved) {
  const std::lock_guard lock(mutex_);
  if (reserved) --samples_;
  if (closed_ || !follow_instance(sample, key)) return;
  if (sample.kind == transport::SampleKind::data) drop_oldest_beyond_depth(key);
  enqueue(Arrived{std::move(sample), key});
}

// False: the reader has nothing to learn from the sample (it disposes an instance that is not alive here).
bool ReaderEnd::follow_instance(transport::Sample& sample, const Key& key) {
  if (!description_.type.keyed) return true;
  if (sample.kind == transport::SampleKind::data) {
    if (instances_.wrote(key, sample.writer)) return true;
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(key.data()), key.size());
    instances_.introduce(key, sample.writer, key_only_payload(bytes));
    return true;
  }
  auto key_payload = instances_.ended(key);
  if (key_payload) sample.payload = std::move(*key_payload);
  return key_payload.has_value();
}

void ReaderEnd::drop_oldest_beyond_depth(const Key& key) {
  const int depth = description_.qos.history_depth;
  if (depth == 0 || waiting_[key] < depth) return;
  const auto oldest = std::find_if(queue_.begin(), queue_.end(), [&key](const Item& item) {
    const auto* arrived = std::get_if<Arrived>(&item);
    return arrived && arrived->sample.kind == transport::SampleKind::data && arrived->key == key;
  });
  queue_.erase(oldest);
  --samples_;
  --waiting_[key];
}

void ReaderEnd::enqueue(Item item) {
  if (const auto* arrived = std::get_if<Arrived>(&item)) {
    ++samples_;
    if (arrived->sample.kind == transport::SampleKind::data) ++waiting_[arrived->key];
  }
  queue_.push_back(std::move(item));
  dispatcher_->post(id_, [self = shared_from_this()] { self->deliver_next(); });
}

void ReaderEnd::deliver_next() {
  std::unique_lock lock(mutex_);
  if (closed_ || queue_.empty()) return;
  Item item = std::move(queue_.front());
  queue_.pop_front();
  auto* arrived = std::get_if<Arrived>(&item);
  if (arrived) {
    --samples_;
    if (arrived->sample.kind == transport::SampleKind::data && --waiting_[arrived->key] == 0)
      waiting_.erase(arrived->key);
    space_.notify_one();
  }
  lock.unlock();
  if (arrived && events_.on_sample) events_.on_sample(std::move(arrived->sample));
  if (arrived) return;
  const Matched& matched = std::get<Matched>(item);
  if (matched.met && events_.on_writer) events_.on_writer(*matched.met);
  if (events_.on_matched) events_.on_matched(matched.writers);
}

void ReaderEnd::attach(const transport::Guid& writer) {
  const std::lock_guard lock(mutex_);
  writers_.insert(writer);
  enqueue(Matched{static_cast<int>(writers_.size()), writer});
}

void ReaderEnd::detach(const transport::Guid& writer) {
  const std::lock_guard lock(mutex_);
  if (closed_ || writers_.erase(writer) == 0) return;
  for (auto& [key, key_payload] : instances_.writer_left(writer)) {
    transport::Sample lost{transport::SampleKind::no_writers, std::move(key_payload), writer};
    enqueue(Arrived{std::move(lost), {}});
  }
  enqueue(Matched{static_cast<int>(writers_.size())});
}

void ReaderEnd::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    queue_.clear();
  }
  space_.notify_all();
  dispatcher_->remove(id_);
}

}  // namespace roci::services::vendors::inproc
