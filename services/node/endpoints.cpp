#include "services/node/endpoints.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "services/bounds/limits.hpp"
#include "services/clock/stream_topic.hpp"
#include "services/log/log.hpp"
#include "services/transport/micro_step.hpp"
#include "services/transport/qos.hpp"

namespace roci::services::node {
namespace {

void check_same_type(const TopicSpec& known, const TopicSpec& wanted) {
  if (known.codec.type.name == wanted.codec.type.name) return;
  throw std::logic_error("topic " + wanted.name + " carries " + known.codec.type.name + ", not " +
                         wanted.codec.type.name);
}

// So many finished instances of a topic stay: what somebody who joins late may want to see of the past.
constexpr std::size_t kFinishedKept = 64;
constexpr std::size_t kLargeFinishedKept = 16;
constexpr std::uint64_t kTurnsOfRest = 2;

// Requests and their answers give nobody their past. Under the simulated clock the newest one of a writer stays all the
// same, because who joins late waits for it. On the live clock the vendor drops what is confirmed.
std::size_t finished_kept(const TopicSpec& topic, bool barriered) {
  if (barriered && topic.qos == transport::Qos::request) return 1;
  return topic.limit < transport::PayloadLimit::batch ? kFinishedKept : kLargeFinishedKept;
}

}  // namespace

std::string stream_topic(const TopicSpec& topic, const std::string& robot) {
  return topic.scope == transport::Scope::robot ? clock::stream_topic(topic.name, robot) : topic.name;
}

TopicWriter::TopicWriter(const NodeOptions& options, const RunIdentity& run, Now now, const TopicSpec& topic,
                         transport::Transport& transport, transport::WriterEvents events)
    : options_(options),
      run_(run),
      now_(std::move(now)),
      topic_(topic),
      finished_(finished_kept(topic, barriered()), barriered() ? kTurnsOfRest : 0) {
  const transport::EndpointDescription endpoint{
      topic.name, topic.codec.type,
      transport::writer_qos(topic.qos, topic.limit, topic.clocking, options.clock),
      transport::partitions_of(topic.scope, options.robot)};
  writer_ = transport.create_writer(endpoint, std::move(events));
  forgets_ = dynamic_cast<transport::ForgetsInstances*>(writer_.get());
}

void TopicWriter::stamp(v1::SampleHeader& header) const {
  header.run(run_.name());
  header.robot(options_.robot);
  header.sender(options_.name);
  header.incarnation(options_.clock == clock::ClockMode::observer ? 0 : options_.incarnation);
  header.seq(total_ + 1);
  header.stamp_us(now_().count());
}

bool TopicWriter::barriered() const {
  return topic_.clocking == transport::Clocking::clocked && clock::is_simulated(options_.clock);
}

std::optional<TopicWriter::Key> TopicWriter::key_of(const transport::Payload& payload) const {
  transport::Payload key;
  const transport::TypeDescription& type = topic_.codec.type;
  if (type.keyed && !type.serialized_key(payload, false, key)) return std::nullopt;
  return Key(key.begin(), key.end());
}

bool TopicWriter::within_limit(const Key& key) {
  return !barriered() || ++written_[key] <= transport::micro_step_limit(topic_.qos, topic_.limit);
}

void TopicWriter::report_refusal(const char* why, const std::string& text) {
  if (const std::uint64_t count = refused_.note(why))
    log::error(options_.name + " " + text + " (" + std::to_string(count) + " so far)");
}

bool TopicWriter::write(const transport::Payload& payload) {
  if (payload.size() > transport::bytes(topic_.limit)) {
    report_refusal("too large", "wants to write " + std::to_string(payload.size()) + " bytes on " +
                                    topic_.name + ", where a sample has at most " +
                                    std::to_string(transport::bytes(topic_.limit)) + "; this one is refused");
    return false;
  }
  const std::optional<Key> key = key_of(payload);
  if (!key) return false;
  if (!within_limit(*key)) {
    if (quiet_) return false;
    report_refusal("too many", "wrote more than " +
                                   std::to_string(transport::micro_step_limit(topic_.qos, topic_.limit)) +
                                   " samples of one instance of " + topic_.name +
                                   " in one micro-step; this one is refused: spread them over mission time");
    return false;
  }
  if (!writer_->write(payload)) return false;
  ++total_;
  finished_.written(*key);
  if (topic_.codec.type.keyed && topic_.qos == transport::Qos::request) finish(payload);
  return true;
}

bool TopicWriter::finish(const transport::Payload& payload) {
  if (forgets_ == nullptr) return true;
  const std::optional<Key> key = key_of(payload);
  if (!key || !topic_.codec.type.keyed) return false;
  finished_.finished(*key, payload);
  if (!barriered()) forget_finished();
  return true;
}

void TopicWriter::forget_finished() {
  for (const transport::Payload& last_word : finished_.take_due()) forgets_->forget(last_word);
}

void TopicWriter::begin_micro_step() {
  written_.clear();
  finished_.end_turn();
  forget_finished();
}

Endpoints::Endpoints(const NodeOptions& options, const RunIdentity& run, TopicWriter::Now now,
                     transport::Transport& transport, Inbox& inbox, ContractCheck& contract,
                     RejectedSamples& rejected)
    : options_(options),
      run_(run),
      now_(std::move(now)),
      transport_(transport),
      inbox_(inbox),
      contract_(contract),
      rejected_(rejected) {}

Endpoints::~Endpoints() { in_.clear(); }  // no callback may find a writer gone

TopicWriter& Endpoints::out(const TopicSpec& topic) {
  auto& stream = out_[topic.name];
  if (!stream) {
    transport::WriterEvents events;
    events.on_matched = [this](int) { inbox_.matched(); };
    events.on_reader = [this, contract = ContractTopic{topic.name, topic.codec.type.name}](
                           const transport::Guid& reader) { contract_.met(contract, reader); };
    stream = std::make_unique<TopicWriter>(options_, run_, now_, topic, transport_, std::move(events));
  }
  check_same_type(stream->topic(), topic);
  return *stream;
}

TopicReader& Endpoints::in(const TopicSpec& topic) {
  auto& input = in_[topic.name];
  if (!input) {
    input = std::make_unique<TopicReader>();
    input->topic = topic;
    input->contract = {topic.name, topic.codec.type.name};
    const transport::EndpointDescription endpoint{
        topic.name, topic.codec.type,
        transport::reader_qos(topic.qos, topic.limit, topic.clocking, options_.clock),
        transport::partitions_of(topic.scope, options_.robot)};
    transport::ReaderEvents events;
    events.on_sample = [this, target = input.get()](transport::Sample&& sample) {
      take(*target, std::move(sample));
    };
    events.on_matched = [this](int) { inbox_.matched(); };
    events.on_writer = [this, target = input.get()](const transport::Guid& writer) {
      contract_.met(target->contract, writer);
    };
    input->reader = transport_.create_reader(endpoint, std::move(events));
  }
  check_same_type(input->topic, topic);
  return *input;
}

// Runs on a vendor's thread.
void Endpoints::take(TopicReader& reader, transport::Sample&& sample) {
  const transport::Guid writer = sample.writer;
  const std::size_t largest = transport::bytes(reader.topic.limit);
  if (sample.payload.size() > largest + transport::kPayloadPadding)
    return rejected_.note(reader.topic.name, SampleRejection::too_large, writer);
  const std::size_t room = std::max(bounds::kInboxBytes, 2 * largest);
  if (!inbox_.push(Arrival{&reader, std::move(sample)}, room))
    rejected_.note(reader.topic.name, SampleRejection::queue_full, writer);
}

TopicReader* Endpoints::find_in(const std::string& topic) {
  const auto found = in_.find(topic);
  return found == in_.end() ? nullptr : found->second.get();
}

std::vector<TopicSpec> Endpoints::clocked_inputs() const {
  std::vector<TopicSpec> topics;
  for (const auto& [name, input] : in_) {
    if (input->topic.clocking == transport::Clocking::clocked) topics.push_back(input->topic);
  }
  return topics;
}

std::vector<std::string> Endpoints::heard_streams(const TopicSpec& topic) const {
  if (topic.scope != transport::Scope::robot) return {topic.name};
  return clock::inner_subscriptions(topic.name, options_.robot);
}

std::vector<v1::StreamCount> Endpoints::take_growth() {
  std::vector<v1::StreamCount> growth;
  for (const auto& [name, stream] : out_) {
    std::uint64_t& reported = reported_[name];
    if (stream->topic().clocking == transport::Clocking::wall || stream->total() == reported) continue;
    reported = stream->total();
    v1::StreamCount count;
    count.topic(stream_topic(stream->topic(), options_.robot));
    count.sender(options_.name);
    count.incarnation(options_.incarnation);
    count.total(reported);
    growth.push_back(std::move(count));
  }
  return growth;
}

void Endpoints::begin_micro_step() {
  for (const auto& [name, stream] : out_) stream->begin_micro_step();
}

}  // namespace roci::services::node
