// These are a node's topics without their types: what is written (TopicWriter) and what is read
// (TopicReader).
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
#include "services/bounds/tally.hpp"
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

/// Holds a payload as a value of its type, or what came before the damage if it is not whole.
struct Decoded {
  std::shared_ptr<const void> value;
  bool whole = false;
};

/// Holds what the loop must know of a type.
struct Codec {
  transport::TypeDescription type;
  Decoded (*decode)(std::span<const std::uint8_t>) = nullptr;
  const v1::SampleHeader& (*header)(const void* value) = nullptr;  ///< null for types without one
  const std::string& (*run)(const void* value) = nullptr;          ///< null for types that name no run
  const std::string& (*sender)(const void* value) = nullptr;       ///< service that says it, by its own word
  transport::Payload (*key)(const void* value) = nullptr;          ///< empty for types without a key
  /// Returns the key in words, or an empty text for types without one.
  std::string (*key_words)(const void* value) = nullptr;
  std::string (*addressee)(const void* value) = nullptr;  ///< service that it is for; empty: everyone
  /// Returns the bytes on the wire, but without the run's name, so that the size is the same in every run. It
  /// is null for types without a header.
  std::size_t (*size)(const void* value) = nullptr;
};

/// Describes a topic as the loop needs it, without its type.
struct TopicSpec {
  std::string name;
  transport::Qos qos = transport::Qos::state;
  transport::Clocking clocking = transport::Clocking::wall;
  transport::Scope scope = transport::Scope::everyone;
  Codec codec;
  transport::PayloadLimit limit = transport::PayloadLimit::journal;
};

/// Returns the name under which the simulated clock counts the samples that a service of `robot` writes on
/// the topic.
std::string stream_topic(const TopicSpec&, const std::string& robot);

/// Writes all samples of one node on one topic.
class TopicWriter {
 public:
  using Now = std::function<temporal::Time()>;  ///< mission time

  TopicWriter(const NodeOptions&, const RunIdentity&, Now, const TopicSpec&, transport::Transport&,
              transport::WriterEvents);

  /// Numbers the next sample; the number counts once write() has succeeded.
  void stamp(v1::SampleHeader&) const;
  bool write(const transport::Payload&);
  /// Finishes the instance, after its last sample. The newest finished ones stay for late joiners; older ones are
  /// forgotten silently if the vendor can. On topics that give nobody their past every sample is the last. Returns
  /// false if the key cannot be read.
  bool finish(const transport::Payload&);

  /// Turns off reports of samples that find no room in a micro-step, since their writer writes them again in
  /// the next one.
  void refuse_quietly() { quiet_ = true; }

  const RunIdentity& run() const { return run_; }
  transport::Guid guid() const { return writer_->guid(); }
  int matched_readers() const { return writer_->matched_readers(); }
  const TopicSpec& topic() const { return topic_; }
  std::uint64_t total() const { return total_; }
  void begin_micro_step();

 private:
  using Key = FinishedInstances::Key;
  /// Returns the key, empty for types without one, or nothing if it cannot be read.
  std::optional<Key> key_of(const transport::Payload&) const;
  bool barriered() const;
  bool within_limit(const Key&);
  void forget_finished();
  // Writes a line to the log for the first sample that is refused for a reason, the tenth, the hundredth, and so on.
  void report_refusal(const char* why, const std::string& text);

  const NodeOptions& options_;
  const RunIdentity& run_;
  Now now_;
  TopicSpec topic_;
  std::unique_ptr<transport::Writer> writer_;
  transport::ForgetsInstances* forgets_ = nullptr;  // the writer, if it can
  std::uint64_t total_ = 0;
  std::unordered_map<Key, int> written_;  // samples of this micro-step
  FinishedInstances finished_;
  bounds::Tally refused_;  // by reason
  bool quiet_ = false;
};

/// Holds what a node does with the samples of one topic.
struct TopicReader {
  TopicSpec topic;
  ContractTopic contract;
  std::vector<std::function<void(const void* value)>> on_value;
  std::vector<std::function<void(const transport::Payload& key)>> on_no_writers;
  std::unique_ptr<transport::Reader> reader;
};

/// Holds the endpoints of one node. A sample that is larger than its topic allows, or finds the inbox full,
/// is dropped on the vendor's thread.
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

  std::vector<TopicSpec> clocked_inputs() const;  ///< sorted by name
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
