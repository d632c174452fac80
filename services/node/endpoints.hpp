// A node's topics without their types: what is written (TopicWriter) and what is read (TopicReader).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/temporal/duration.hpp"
#include "roci_idl/basic.h"
#include "roci_idl/clock.h"
#include "services/node/contract_check.hpp"
#include "services/node/finished_instances.hpp"
#include "services/node/inbox.hpp"
#include "services/node/node_options.hpp"
#include "services/node/rejected_samples.hpp"
#include "services/node/run_identity.hpp"
#include "services/transport/forgets_instances.hpp"
#include "services/transport/payload_limit.hpp"
#include "services/transport/scope.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::node {

/// A payload as a value of its type; what came before the damage, if it is not whole.
struct Decoded {
  std::shared_ptr<const void> value;
  bool whole = false;
};

/// The loop must know this of a type.
struct Codec {
  transport::TypeDescription type;
  Decoded (*decode)(std::span<const std::uint8_t>) = nullptr;
  const v1::SampleHeader& (*header)(const void* value) = nullptr;  ///< Null for types without one.
  const std::string& (*run)(const void* value) = nullptr;          ///< null for types that name no run
  const std::string& (*sender)(const void* value) = nullptr;  ///< The service that says it, by its own word.
  transport::Payload (*key)(const void* value) = nullptr;     ///< Empty for types without a key.
  /// The key for people; empty for types without one.
  std::string (*key_words)(const void* value) = nullptr;
  std::string (*addressee)(const void* value) = nullptr;  ///< The service that it is for; empty: everyone.
  /// In bytes as on the wire, but without the run's name, so that it is the same in every run. Null for types
  /// without a header.
  std::size_t (*size)(const void* value) = nullptr;
};

struct TopicSpec {
  std::string name;
  transport::Qos qos = transport::Qos::state;
  transport::Clocking clocking = transport::Clocking::wall;
  transport::Scope scope = transport::Scope::everyone;
  Codec codec;
  transport::PayloadLimit limit = transport::PayloadLimit::journal;
};

/// The name under which the simulated clock counts the samples that a service of `robot` writes on the topic.
std::string stream_topic(const TopicSpec&, const std::string& robot);

/// Writes all samples of one node on one topic.
class TopicWriter {
 public:
  using Now = std::function<temporal::Time()>;  ///< Mission time.

  TopicWriter(const NodeOptions&, const RunIdentity&, Now, const TopicSpec&, transport::Transport&,
              transport::WriterEvents);

  /// Numbers the next sample; the number counts once write() has succeeded.
  void stamp(v1::SampleHeader&) const;
  bool write(const transport::Payload&);
  /// Says that the instance has its last word. The newest of these stay for late joiners; older ones are forgotten if
  /// the vendor can, and nobody is told. Of topics whose past nobody is given each word is the last.
  /// False: the key cannot be read.
  bool finish(const transport::Payload&);

  /// What a micro-step has no room for is written again in the next by whoever writes here, so nobody is told.
  void refuse_quietly() { quiet_ = true; }

  const RunIdentity& run() const { return run_; }
  transport::Guid guid() const { return writer_->guid(); }
  int matched_readers() const { return writer_->matched_readers(); }
  const TopicSpec& topic() const { return topic_; }
  std::uint64_t total() const { return total_; }
  void begin_micro_step();

 private:
  using Key = FinishedInstances::Key;
  /// Empty for types without a key; nothing if it cannot be read.
  std::optional<Key> key_of(const transport::Payload&) const;
  bool barriered() const;
  bool within_limit(const Key&);
  void forget_finished();

  const NodeOptions& options_;
  const RunIdentity& run_;
  Now now_;
  TopicSpec topic_;
  std::unique_ptr<transport::Writer> writer_;
  transport::ForgetsInstances* forgets_ = nullptr;  // the writer, if it can
  std::uint64_t total_ = 0;
  std::unordered_map<Key, int> written_;  // samples of this micro-step
  FinishedInstances finished_;
  bool quiet_ = false;
};

struct TopicReader {
  TopicSpec topic;
  ContractTopic contract;
  std::vector<std::function<void(const void* value)>> on_value;
  std::vector<std::function<void(const transport::Payload& key)>> on_no_writers;
  std::unique_ptr<transport::Reader> reader;
};

/// What is larger than its topic allows, or finds the inbox full, goes no further than the vendor's thread.
class Endpoints {
 public:
  Endpoints(const NodeOptions&, const RunIdentity&, TopicWriter::Now, transport::Transport&, Inbox&,
            ContractCheck&, RejectedSamples&);
  ~Endpoints();

  /// Return the node's one writer or reader of a topic. They throw std::logic_error if the topic is known
  /// with another type.
  TopicWriter& out(const TopicSpec&);
  TopicReader& in(const TopicSpec&);
  TopicReader* find_in(const std::string& topic);

  std::vector<TopicSpec> clocked_inputs() const;  ///< They are sorted by name.
  /// Returns the streams of a topic that this node hears (clock/stream_topic.hpp), as the clock names them.
  std::vector<std::string> heard_streams(const TopicSpec&) const;
  /// Returns the clocked streams with samples that it has not yet reported.
  std::vector<v1::StreamCount> take_growth();
  void begin_micro_step();

 private:
  void take(TopicReader&, transport::Sample&&);

  const NodeOptions& options_;
  const RunIdentity& run_;
  TopicWriter::Now now_;
  transport::Transport& transport_;
  Inbox& inbox_;
  ContractCheck& contract_;
  RejectedSamples& rejected_;
  std::map<std::string, std::unique_ptr<TopicWriter>> out_;
  std::map<std::string, std::unique_ptr<TopicReader>> in_;
  std::map<std::string, std::uint64_t> reported_;
};

}  // namespace roci::services::node
