// What a reader under test received, and waiting for it: on a condition variable, with a generous deadline.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::services::contract {

inline constexpr std::chrono::seconds kDeadline{20};

class Inbox {
 public:
  // The callbacks refer to this inbox: destroy the reader or writer first.
  transport::ReaderEvents reader_events();
  transport::WriterEvents writer_events();

  // Waits until `done` holds; false at the deadline. `done` is called under the inbox's lock, which the
  // getters below do not take: call them inside `done` or in the waiting thread while nothing arrives any
  // more.
  bool wait_until(const std::function<bool()>& done, std::chrono::milliseconds deadline = kDeadline);
  bool wait_for_match(int count = 1);
  bool wait_for_samples(std::size_t count);

  std::vector<transport::Sample> samples() const;
  int matched() const;

  // "id=priority" of the goals received, in order.
  std::vector<std::string> goals() const;
  // "issuer/id" of the instances that ended in this way, in order.
  std::vector<std::string> ended(transport::SampleKind) const;

 private:
  mutable std::recursive_mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<transport::Sample> samples_;
  int matched_ = 0;
};

}  // namespace roci::services::contract
