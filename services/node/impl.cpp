#include "services/node/impl.hpp"

#include <stdexcept>
#include <utility>

#include "services/log.hpp"

namespace roci::services {
namespace {

constexpr std::size_t kForeignRuns = 16;

bool simulated(ClockMode mode) { return mode == ClockMode::simulated || mode == ClockMode::master; }

}  // namespace

Node::Impl::Impl(Node& node, NodeOptions node_options, std::unique_ptr<Transport> node_transport)
    : options(std::move(node_options)),
      run(options.run),
      transport(std::move(node_transport)),
      work(simulated(options.clock) ? ResultOrder::as_begun : ResultOrder::as_finished),
      endpoints(node, *transport, inbox) {}

InTopic& Node::Impl::subscribe(const TopicSpec& topic) {
  const bool barriered = topic.clocking == Clocking::clocked && simulated(options.clock);
  if (running && barriered && endpoints.find_in(topic.name) == nullptr) {
    throw std::logic_error(
        options.name + " subscribes to " + topic.name +
        " while it runs; under the simulated clock subscribe (or make clients) before run()");
  }
  return endpoints.in(topic);
}

void Node::Impl::take_in(Arrival&& arrival) {
  InTopic& input = *arrival.topic;
  if (arrival.sample.kind == SampleKind::owner_lost) {
    for (const auto& lost : input.on_owner_lost) lost(arrival.sample.payload);
  }
  if (arrival.sample.kind != SampleKind::data) return;
  auto value = input.topic.codec.decode(arrival.sample.payload);
  if (!value) {
    ++input.malformed;
    log_warning(options.name + " drops a malformed sample of " + input.topic.name);
    return;
  }
  if (input.topic.codec.run && !is_of_this_run(input.topic.codec.run(value.get()), input.topic.name)) return;
  if (input.topic.clocking == Clocking::wall) return handle(input, value.get());
  const v1::SampleHeader& header = input.topic.codec.header(value.get());
  loop->take_clocked(input, header, std::move(value));
}

bool Node::Impl::is_of_this_run(const std::string& sample_run, const std::string& topic) {
  if (run.empty() && options.clock == ClockMode::observer) run = sample_run;
  if (sample_run == run) return true;
  const auto known = foreign.find(sample_run);
  if (known != foreign.end()) {
    ++known->second;
  } else if (foreign.size() < kForeignRuns) {
    foreign[sample_run] = 1;
    log_warning(options.name + " hears another run, \"" + sample_run + "\", on " + topic +
                " and does not obey it; give each run a domain of its own");
  }
  return false;
}

void Node::Impl::handle(InTopic& input, const void* value) {
  // By index: a handler may subscribe, live.
  for (std::size_t i = 0; i < input.on_value.size(); ++i) {
    const auto handler = input.on_value[i];
    handler(value);
  }
}

void Node::Impl::announce(const PeerChange& change) {
  for (std::size_t i = 0; i < on_peer_change.size(); ++i) {
    const auto handler = on_peer_change[i];
    handler(change);
  }
}

void Node::Impl::announce_turn() {
  for (std::size_t i = 0; i < on_turn.size(); ++i) {
    const auto handler = on_turn[i];
    handler();
  }
}

void Node::Impl::announce_match() {
  for (std::size_t i = 0; i < on_match.size(); ++i) {
    const auto handler = on_match[i];
    handler();
  }
}

}  // namespace roci::services
