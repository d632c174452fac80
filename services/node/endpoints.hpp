// A node's topics without their types: what is written (OutStream) and what is read (InTopic).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/temporal/duration.hpp"
#include "roci_idl/basic.h"
#include "roci_idl/clock.h"
#include "services/node/inbox.hpp"
#include "services/node/node_options.hpp"
#include "services/node/run_identity.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::node {

// What the loop must know of a type.
struct Codec {
  transport::TypeDescription type;
  std::shared_ptr<const void> (*decode)(std::span<const std::uint8_t>) = nullptr;  // null: malformed payload
  const v1::SampleHeader& (*header)(const void* value) = nullptr;  // null for types without one
  const std::string& (*run)(const void* value) = nullptr;          // null for types that name no run
  transport::Payload (*key)(const void* value) = nullptr;          // empty for types without a key
};

struct TopicSpec {
  std::string name;
  transport::Qos qos = transport::Qos::state;
  transport::Clocking clocking = transport::Clocking::wall;
  Codec codec;
};

// All samples of one node on one topic.
class OutStream {
 public:
  using Now = std::function<temporal::Time()>;  ///< Mission time.

  OutStream(const NodeOptions&, const RunIdentity&, Now, const TopicSpec&, transport::Transport&,
            std::function<void()> on_matched);

  // Numbers the next sample; the number counts once write() has succeeded.
  void stamp(v1::SampleHeader&) const;
  bool write(const transport::Payload&);
  bool dispose(const transport::Payload&);

  const RunIdentity& run() const { return run_; }
  transport::Guid guid() const { return writer_->guid(); }
  int matched_readers() const { return writer_->matched_readers(); }
  const TopicSpec& topic() const { return topic_; }
  std::uint64_t total() const { return total_; }
  void begin_micro_step() { written_.clear(); }

 private:
  bool within_limit(const transport::Payload&);

  const NodeOptions& options_;
  const RunIdentity& run_;
  Now now_;
  TopicSpec topic_;
  std::unique_ptr<transport::Writer> writer_;
  std::uint64_t total_ = 0;
  std::unordered_map<std::string, int> written_;  // samples of this micro-step by key
};

struct InTopic {
  TopicSpec topic;
  std::vector<std::function<void(const void* value)>> on_value;
  std::vector<std::function<void(const transport::Payload& key)>> on_owner_lost;
  std::uint64_t malformed = 0;
  std::unique_ptr<transport::Reader> reader;
};

class Endpoints {
 public:
  Endpoints(const NodeOptions&, const RunIdentity&, OutStream::Now, transport::Transport&, Inbox&);
  ~Endpoints();

  // The node's one writer or reader of a topic. Throws std::logic_error if the topic is known with another
  // type.
  OutStream& out(const TopicSpec&);
  InTopic& in(const TopicSpec&);
  InTopic* find_in(const std::string& topic);

  std::vector<TopicSpec> clocked_inputs() const;  // by name
  // Clocked streams with samples that this did not yet report.
  std::vector<v1::StreamCount> take_growth();
  void begin_micro_step();

 private:
  const NodeOptions& options_;
  const RunIdentity& run_;
  OutStream::Now now_;
  transport::Transport& transport_;
  Inbox& inbox_;
  std::map<std::string, std::unique_ptr<OutStream>> out_;
  std::map<std::string, std::unique_ptr<InTopic>> in_;
  std::map<std::string, std::uint64_t> reported_;
};

}  // namespace roci::services::node
