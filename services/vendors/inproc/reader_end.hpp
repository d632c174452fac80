// The reader end is the receiving end of an inproc topic.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <unordered_map>
#include <variant>

#include "services/transport/transport.hpp"
#include "services/vendors/inproc/dispatcher.hpp"
#include "services/vendors/instance_table.hpp"

namespace roci::services::vendors::inproc {

/// Holds the big-endian CDR of the key members; empty for types without key.
using Key = InstanceTable::Key;

/// Keeps a queue of samples and the life of each instance, as a DDS reader does.
class ReaderEnd : public std::enable_shared_from_this<ReaderEnd> {
 public:
  ReaderEnd(transport::EndpointDescription, transport::ReaderEvents, std::shared_ptr<Dispatcher>,
            Dispatcher::Endpoint, const transport::Guid&);

  const transport::EndpointDescription& description() const { return description_; }
  const transport::Guid& guid() const { return guid_; }
  int matched_writers() const;

  /// Books a place in the queue. Returns false when a reliable keep-all queue stayed full for `max_wait`.
  bool reserve(std::chrono::milliseconds max_wait);
  void release();
  /// Delivers a sample, which takes a booked place if `reserved`.
  void push(transport::Sample, const Key&, bool reserved);

  void attach(const transport::Guid& writer);
  /// Detaches a writer; instances without any other writer are reported as no_writers.
  void detach(const transport::Guid& writer);
  /// Closes this end: when it returns, no callback runs, and none follows.
  void close();

 private:
  struct Arrived {
    transport::Sample sample;
    Key key;
  };
  struct Matched {
    int writers;
    std::optional<transport::Guid> met{};  // the writer that is new
  };
  using Item = std::variant<Arrived, Matched>;

  bool limited() const;
  bool follow_instance(transport::Sample&, const Key&);
  void drop_oldest_beyond_depth(const Key&);
  void enqueue(Item);
  void deliver_next();

  const transport::EndpointDescription description_;
  const transport::ReaderEvents events_;
  const std::shared_ptr<Dispatcher> dispatcher_;
  const Dispatcher::Endpoint id_;
  const transport::Guid guid_;

  mutable std::mutex mutex_;
  std::condition_variable space_;
  bool closed_ = false;
  std::set<transport::Guid> writers_;
  std::deque<Item> queue_;
  int samples_ = 0;                       // in queue_, and booked
  std::unordered_map<Key, int> waiting_;  // samples in queue_ per instance, for keep last
  InstanceTable instances_;
};

}  // namespace roci::services::vendors::inproc
