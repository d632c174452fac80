#include "services/node/node_impl.hpp"

#include <stdexcept>
#include <utility>

#include "services/log/log.hpp"
#include "services/node/make_event.hpp"
#include "services/node/typed_endpoints.hpp"

namespace roci::services::node {
NodeImpl::NodeImpl(NodeOptions node_options, std::unique_ptr<transport::Transport> node_transport)
    : options(std::move(node_options)),
      run(options.name, options.run, options.clock == clock::ClockMode::observer),
      transport(std::move(node_transport)),
      contract(transport->announcement(),
               [this](const transport::Guid& guid) { return transport->participant_of(guid); }),
      rejected(
          options.name, [this](const transport::Guid& guid) { return transport->participant_of(guid); },
          [this] { advertise(*this, topics::event); },
          [this](const v1::Event& event) { write(advertise(*this, topics::event), event); },
          simulated() ? 0 : RejectedSamples::kTellAfterS),
      datagrams(options.name, dynamic_cast<const transport::RefusesDatagrams*>(transport.get())),
      work(simulated() ? ResultOrder::as_begun : ResultOrder::as_finished),
      endpoints(
          options, run, [this] { return now(); }, *transport, inbox, contract, rejected),
      links(options),
      gate(
          contract, [this](Arrival&& arrival) { read(std::move(arrival)); },
          [this] { advertise(*this, topics::event); },
          [this](const v1::Event& event) { write(advertise(*this, topics::event), event); }),
      loop(simulated() ? make_sim_loop(*this) : make_live_loop(*this)) {}

TimerQueue::Id NodeImpl::after(temporal::Duration wait, std::function<void()> fire) {
  return timers.add(loop->timer_now() + wait, std::move(fire));
}

health::PeerState NodeImpl::peer(std::string_view service) const {
  return service == options.name ? health::PeerState::alive : loop->peer(service);
}

TopicReader& NodeImpl::subscribe(const TopicSpec& topic) {
  const bool barriered = topic.clocking == transport::Clocking::clocked && simulated();
  if (running && barriered && endpoints.find_in(topic.name) == nullptr) {
    throw std::logic_error(
        options.name + " subscribes to " + topic.name +
        " while it runs; under the simulated clock subscribe (or make clients) before run()");
  }
  return endpoints.in(topic);
}

void NodeImpl::receive(Arrival&& arrival) { gate.arrive(std::move(arrival)); }

void NodeImpl::read(Arrival&& arrival) {
  TopicReader& input = *arrival.topic;
  if (arrival.sample.kind == transport::SampleKind::no_writers) {
    for (const auto& lost : input.on_no_writers) lost(arrival.sample.payload);
  }
  if (arrival.sample.kind != transport::SampleKind::data) return;
  Decoded decoded = input.topic.codec.decode(arrival.sample.payload);
  if (!decoded.whole) return refuse_malformed(input, decoded, arrival.sample.writer);
  const std::shared_ptr<const void> value = std::move(decoded.value);
  const auto sender_of = input.topic.codec.sender;
  if (sender_of != nullptr && !transport->speaks_as(arrival.sample.writer, sender_of(value.get())))
    return rejected.note(input.topic.name, SampleRejection::another_name, arrival.sample.writer);
  const auto run_of = input.topic.codec.run;
  if (run_of != nullptr && !run.obeys(run_of(value.get()), input.topic.name)) {
    for (const auto& [foreign, topic] : run.take_news())
      if (options.clock != clock::ClockMode::observer)
        tell("run.foreign",
             options.name + " hears another run, \"" + foreign + "\", on " + topic + " and does not obey it");
    return;
  }
  if (input.topic.clocking == transport::Clocking::wall) return handle(input, value.get());
  const v1::SampleHeader& header = input.topic.codec.header(value.get());
  loop->take_clocked(input, header, value);
}

// The header comes early in a sample. Where it could be read the simulated clock counts the sample, without a value:
// else this node would wait for it for ever.
void NodeImpl::refuse_malformed(TopicReader& input, const Decoded& decoded, const transport::Guid& writer) {
  rejected.note(input.topic.name, SampleRejection::malformed, writer);
  const Codec& codec = input.topic.codec;
  if (!simulated() || input.topic.clocking == transport::Clocking::wall) return;
  const v1::SampleHeader& header = codec.header(decoded.value.get());
  if (header.incarnation() != 0 && header.seq() != 0 && run.obeys(header.run(), input.topic.name))
    loop->take_clocked(input, header, nullptr);
}

void NodeImpl::handle(TopicReader& input, const void* value) {
  // By index: a handler may subscribe, live.
  for (std::size_t i = 0; i < input.on_value.size(); ++i) {
    const auto handler = input.on_value[i];
    handler(value);
  }
}

void NodeImpl::announce(const health::PeerChange& change) {
  for (std::size_t i = 0; i < on_peer_change.size(); ++i) {
    const auto handler = on_peer_change[i];
    handler(change);
  }
}

void NodeImpl::announce_turn() {
  const clock::WallTime now = clock::wall_now();
  gate.turn(now);
  rejected.turn(now);
  // An observer hears of what the services of the run refuse, and says nothing itself.
  if (options.clock != clock::ClockMode::observer)
    for (v1::Event& event : datagrams.turn(now)) gate.tell_later(std::move(event), now);
  for (std::size_t i = 0; i < on_turn.size(); ++i) {
    const auto handler = on_turn[i];
    handler();
  }
}

void NodeImpl::announce_match() {
  for (std::size_t i = 0; i < on_match.size(); ++i) {
    const auto handler = on_match[i];
    handler();
  }
}

health::HeartbeatSender NodeImpl::make_heartbeat_sender() {
  TopicWriter& stream = advertise(*this, topics::heartbeat);
  v1::Heartbeat identity;
  identity.service(options.name);
  identity.mission(options.mission);
  identity.robot(options.robot);
  identity.incarnation(options.incarnation);
  identity.dds(options.vendor);
  health::HeartbeatSender sender(std::move(identity),
                                 [&stream](const v1::Heartbeat& beat) { write(stream, beat); });
  if (options.sole) namesakes_.emplace(sender.identity());
  return sender;
}

void NodeImpl::hear_namesake(const v1::Heartbeat& beat) {
  if (!namesakes_) return;
  const auto precedence = namesakes_->hear(beat, clock::wall_now());
  if (precedence == health::NamesakeWatch::Precedence::nothing) return;
  const std::string other = health::process_text(beat);
  if (precedence == health::NamesakeWatch::Precedence::yields) {
    const std::string text =
        "this run has another " + other + ", which goes on in this name; this process ends";
    gate.tell_now(make_event(v1::SEVERITY_WARNING, "service.doubled", text));
    throw health::Superseded(text);
  }
  log::warning(options.name + ": this run has another " + other);
  tell("service.doubled", "this run has another " + other + "; that one ends, this one goes on");
}

void NodeImpl::tell(const std::string& code, const std::string& text) {
  gate.tell_later(make_event(v1::SEVERITY_WARNING, code, text), clock::wall_now());
}

}  // namespace roci::services::node
