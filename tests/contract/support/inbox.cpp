#include "tests/contract/support/inbox.hpp"

#include "roci_idl/goal.h"
#include "services/transport/type_support.hpp"

namespace roci::services::contract {

transport::ReaderEvents Inbox::reader_events() {
  return {[this](transport::Sample&& sample) {
            const std::lock_guard lock(mutex_);
            samples_.push_back(std::move(sample));
            changed_.notify_all();
          },
          writer_events().on_matched};
}

transport::WriterEvents Inbox::writer_events() {
  return {[this](int count) {
    const std::lock_guard lock(mutex_);
    matched_ = count;
    changed_.notify_all();
  }};
}

bool Inbox::wait_until(const std::function<bool()>& done, std::chrono::milliseconds deadline) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, deadline, done);
}

bool Inbox::wait_for_match(int count) {
  return wait_until([this, count] { return matched_ == count; });
}

bool Inbox::wait_for_samples(std::size_t count) {
  return wait_until([this, count] { return samples_.size() >= count; });
}

std::vector<transport::Sample> Inbox::samples() const {
  const std::lock_guard lock(mutex_);
  return samples_;
}

int Inbox::matched() const {
  const std::lock_guard lock(mutex_);
  return matched_;
}

std::vector<std::string> Inbox::goals() const {
  std::vector<std::string> goals;
  for (const auto& sample : samples()) {
    v1::Goal value;
    if (sample.kind != transport::SampleKind::data) continue;
    goals.push_back(transport::deserialize(sample.payload, value)
                        ? value.id() + "=" + std::to_string(value.priority())
                        : "undecodable");
  }
  return goals;
}

std::vector<std::string> Inbox::ended(transport::SampleKind kind) const {
  std::vector<std::string> keys;
  for (const auto& sample : samples()) {
    v1::Goal value;
    if (sample.kind != kind) continue;
    keys.push_back(transport::deserialize_key(sample.payload, value) ? value.issuer() + "/" + value.id()
                                                                     : "undecodable");
  }
  return keys;
}

}  // namespace roci::services::contract
