#include "services/node.hpp"

#include <utility>

#include "services/node/node_impl.hpp"

namespace roci::services {

Node::Node(node::NodeOptions options, std::unique_ptr<transport::Transport> transport)
    : impl_(std::make_unique<node::NodeImpl>(std::move(options), std::move(transport))) {}

Node::~Node() = default;

const node::NodeOptions& Node::options() const { return impl_->options; }

temporal::Time Node::now() const { return impl_->now(); }

Node::TimerId Node::at(temporal::Time due, std::function<void()> fire) {
  return after(due - now(), std::move(fire));
}

Node::TimerId Node::after(temporal::Duration wait, std::function<void()> fire) {
  return impl_->after(wait, std::move(fire));
}

void Node::cancel(TimerId timer) { impl_->timers.cancel(timer); }

void Node::on_turn(std::function<void()> handler) { impl_->on_turn.push_back(std::move(handler)); }

std::map<std::string, temporal::Duration> Node::round_trips() const { return impl_->links.round_trips(); }

std::map<std::string, link::Counts> Node::link_counts() const { return impl_->links.counts(); }

const std::vector<link::LostSample>& Node::lost_samples() const { return impl_->links.lost(); }

void Node::on_peer_change(std::function<void(const health::PeerChange&)> handler) {
  impl_->on_peer_change.push_back(std::move(handler));
}

bool Node::peer_alive(std::string_view service) const {
  return impl_->peer(service) == health::PeerState::alive;
}

const std::map<std::string, std::uint64_t>& Node::foreign_runs() const { return impl_->run.foreign(); }

Node::WorkId Node::begin_work() { return impl_->work.begin(); }

void Node::post_work_result(WorkId work, std::function<void()> run) {
  impl_->inbox.push(node::WorkResult{work, std::move(run)});
}

void Node::stop() { impl_->inbox.stop(); }

void Node::run() {
  impl_->running = true;
  impl_->loop->run();
}

void Node::spin_once(std::chrono::milliseconds wait) { impl_->loop->spin_once(wait); }

}  // namespace roci::services
