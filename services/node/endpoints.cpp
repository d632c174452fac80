#include "services/node/endpoints.hpp"

#include <stdexcept>
#include <utility>

#include "services/log.hpp"
#include "services/node/impl.hpp"
#include "services/qos.hpp"

namespace roci::services {
namespace {

void check_same_type(const TopicSpec& known, const TopicSpec& wanted) {
  if (known.codec.type.name == wanted.codec.type.name) return;
  throw std::logic_error("topic " + wanted.name + " carries " + known.codec.type.name + ", not " +
                         wanted.codec.type.name);
}

bool simulated(const Node& node) {
  const ClockMode mode = node.options().clock;
  return mode == ClockMode::simulated || mode == ClockMode::master;
}

}  // namespace

OutStream::OutStream(Node& node, const TopicSpec& topic, Transport& transport,
                     std::function<void()> on_matched)
    : node_(node), topic_(topic) {
  const EndpointDescription endpoint{topic.name, topic.codec.type,
                                     writer_qos(topic.qos, topic.clocking, node.options().clock)};
  writer_ = transport.create_writer(endpoint, {[on_matched = std::move(on_matched)](int) { on_matched(); }});
}

void OutStream::stamp(v1::SampleHeader& header) const {
  const NodeOptions& options = node_.options();
  header.run(run());
  header.robot(options.robot);
  header.sender(options.name);
  header.incarnation(options.clock == ClockMode::observer ? 0 : options.incarnation);
  header.seq(total_ + 1);
  header.stamp_us(node_.now().count());
}

const std::string& OutStream::run() const { return node_.impl().run; }

bool OutStream::within_limit(const Payload& payload) {
  if (topic_.clocking == Clocking::wall || !simulated(node_)) return true;
  Payload key;
  const TypeDescription& type = topic_.codec.type;
  if (type.keyed && !type.serialized_key(payload, false, key)) return false;
  return ++written_[std::string(key.begin(), key.end())] <= kMicroStepLimit;
}

bool OutStream::write(const Payload& payload) {
  if (!within_limit(payload)) {
    log_error(node_.options().name + " wrote more than " + std::to_string(kMicroStepLimit) +
              " samples of one instance of " + topic_.name +
              " in one micro-step; this one is refused: spread them over mission time");
    return false;
  }
  if (!writer_->write(payload)) return false;
  ++total_;
  return true;
}

bool OutStream::dispose(const Payload& payload) { return writer_->dispose(payload); }

Endpoints::Endpoints(Node& node, Transport& transport, Inbox& inbox)
    : node_(node), transport_(transport), inbox_(inbox) {}

Endpoints::~Endpoints() { in_.clear(); }  // no callback may find a writer gone

OutStream& Endpoints::out(const TopicSpec& topic) {
  auto& stream = out_[topic.name];
  if (!stream) stream = std::make_unique<OutStream>(node_, topic, transport_, [this] { inbox_.matched(); });
  check_same_type(stream->topic(), topic);
  return *stream;
}

InTopic& Endpoints::in(const TopicSpec& topic) {
  auto& input = in_[topic.name];
  if (!input) {
    input = std::make_unique<InTopic>();
    input->topic = topic;
    const EndpointDescription endpoint{topic.name, topic.codec.type,
                                       reader_qos(topic.qos, topic.clocking, node_.options().clock)};
    ReaderEvents events;
    events.on_sample = [this, target = input.get()](Sample&& sample) {
      inbox_.push(Arrival{target, std::move(sample)});
    };
    events.on_matched = [this](int) { inbox_.matched(); };
    input->reader = transport_.create_reader(endpoint, std::move(events));
  }
  check_same_type(input->topic, topic);
  return *input;
}

InTopic* Endpoints::find_in(const std::string& topic) {
  const auto found = in_.find(topic);
  return found == in_.end() ? nullptr : found->second.get();
}

std::vector<TopicSpec> Endpoints::clocked_inputs() const {
  std::vector<TopicSpec> topics;
  for (const auto& [name, input] : in_) {
    if (input->topic.clocking == Clocking::clocked) topics.push_back(input->topic);
  }
  return topics;
}

std::vector<v1::StreamCount> Endpoints::take_growth() {
  std::vector<v1::StreamCount> growth;
  for (const auto& [name, stream] : out_) {
    std::uint64_t& reported = reported_[name];
    if (stream->topic().clocking == Clocking::wall || stream->total() == reported) continue;
    reported = stream->total();
    v1::StreamCount count;
    count.topic(name);
    count.sender(node_.options().name);
    count.incarnation(node_.options().incarnation);
    count.total(reported);
    growth.push_back(std::move(count));
  }
  return growth;
}

void Endpoints::begin_micro_step() {
  for (const auto& [name, stream] : out_) stream->begin_micro_step();
}

}  // namespace roci::services
