#include "services/rpc/reply_cache.hpp"

namespace roci::services::rpc {

ReplyCache::Request& ReplyCache::entry(const Id& id) {
  const auto [entry, fresh] = known_.try_emplace(id);
  if (fresh) {
    order_.push_back(id);
    if (order_.size() > kCachedReplies) {
      known_.erase(order_.front());
      order_.pop_front();
    }
  }
  return entry->second;
}

bool ReplyCache::accept(const Id& id) {
  Request& request = entry(id);
  if (!std::exchange(request.seen, true)) return true;
  if (request.send_again) request.send_again();
  return false;
}

void ReplyCache::answered(const Id& id, SendAgain send_again) {
  const auto found = known_.find(id);
  if (found == known_.end()) return;
  found->second.send_again = std::move(send_again);
  found->second.on_cancel = nullptr;
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
  write_(reply.get());
  server_->answered(id(), [write = write_, reply] { write(reply.get()); });
}

void PendingReply::on_cancel(std::function<void()> handler) { server_->on_cancel(id(), std::move(handler)); }

}  // namespace roci::services::rpc
