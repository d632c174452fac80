#include "services/rpc/reply_cache.hpp"

#include <utility>

#include "services/bounds/limits.hpp"

namespace roci::services::rpc {

ReplyCache::Request& ReplyCache::entry(const Id& id) {
  const auto [entry, fresh] = known_.try_emplace(id);
  if (fresh) {
    order_.push_back(id);
    if (order_.size() > kCachedReplies) forget_oldest();
  }
  return entry->second;
}

void ReplyCache::forget_oldest() {
  const auto oldest = known_.find(order_.front());
  bytes_ -= oldest->second.bytes;
  known_.erase(oldest);
  order_.pop_front();
}

bool ReplyCache::accept(const Id& id) {
  Request& request = entry(id);
  if (!std::exchange(request.seen, true)) return true;
  if (request.send_again) request.send_again();
  return false;
}

void ReplyCache::answered(const Id& id, SendAgain send_again, std::size_t bytes) {
  const auto found = known_.find(id);
  if (found == known_.end()) return;
  found->second.send_again = std::move(send_again);
  found->second.on_cancel = nullptr;
  bytes_ += bytes - std::exchange(found->second.bytes, bytes);
  while (bytes_ > bounds::kCachedReplyBytes && order_.front() != id) forget_oldest();
}

void ReplyCache::cancel(const Id& id) {
  Request& request = entry(id);
  if (std::exchange(request.cancelled, true) || !request.on_cancel) return;
  const auto handler = std::exchange(request.on_cancel, nullptr);
  handler();
}

void ReplyCache::on_cancel(const Id& id, std::function<void()> handler) {
  const auto found = known_.find(id);
  if (found == known_.end() || found->second.send_again) return;
  if (found->second.cancelled) {
    handler();
  } else {
    found->second.on_cancel = std::move(handler);
  }
}

void PendingReply::answer(std::shared_ptr<const void> reply) {
  if (answered_) return;
  answered_ = true;
  const std::size_t bytes = write_(reply);
  server_->end();
  if (!keeps_) return server_->answered(id(), [] {});
  server_->answered(
      id(), [write = write_, reply] { write(reply); }, bytes);
}

PendingReply::~PendingReply() {
  if (!answered_) server_->end();
}

void PendingReply::on_cancel(std::function<void()> handler) { server_->on_cancel(id(), std::move(handler)); }

}  // namespace roci::services::rpc
