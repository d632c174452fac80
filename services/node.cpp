#include "services/node.hpp"

#include <utility>

#include "services/node/impl.hpp"
#include "services/transport.hpp"

namespace roci::services {

Node::Node(NodeOptions options, std::unique_ptr<Transport> transport)
    : impl_(std::make_unique<Impl>(*this, std::move(options), std::move(transport))) {
  const ClockMode mode = impl_->options.clock;
  const bool simulated = mode == ClockMode::simulated || mode == ClockMode::master;
  impl_->loop = simulated ? make_sim_loop(*this) : make_live_loop(*this);
}

Node::~Node() = default;

const NodeOptions& Node::options() const { return impl_->options; }

Time Node::now() const { return impl_->loop->now(); }

Node::TimerId Node::at(Time due, std::function<void()> fire) { return after(due - now(), std::move(fire)); }

Node::TimerId Node::after(Duration wait, std::function<void()> fire) {
  return impl_->timers.add(impl_->loop->timer_now() + wait, std::move(fire));
}

void Node::cancel(TimerId timer) { impl_->timers.cancel(timer); }

void Node::on_turn(std::function<void()> handler) { impl_->on_turn.push_back(std::move(handler)); }

void Node::on_peer_change(std::function<void(const PeerChange&)> handler) {
  impl_->on_peer_change.push_back(std::move(handler));
}

bool Node::peer_alive(std::string_view service) const {
  return service == impl_->options.name || impl_->loop->peer(service) == PeerState::alive;
}

Node::WorkId Node::begin_work() { return impl_->work.begin(); }

void Node::post_work_result(WorkId work, std::function<void()> run) {
  impl_->inbox.push(WorkResult{work, std::move(run)});
}

void Node::stop() { impl_->inbox.stop(); }

void Node::run() {
  impl_->running = true;
  impl_->loop->run();
}

void Node::spin_once(std::chrono::milliseconds wait) { impl_->loop->spin_once(wait); }

}  // namespace roci::services
