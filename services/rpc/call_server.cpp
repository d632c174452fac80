#include "services/rpc/call_server.hpp"

namespace roci::services {

bool CallServer::accept(const Id& id) {
  const auto [entry, fresh] = known_.try_emplace(id);
  if (!fresh) {
    if (entry->second) entry->second();
    return false;
  }
  order_.push_back(id);
  if (order_.size() > kRememberedAnswers) {
    known_.erase(order_.front());
    order_.pop_front();
  }
  return true;
}

void CallServer::answered(const Id& id, SendAgain send_again) {
  const auto found = known_.find(id);
  if (found != known_.end()) found->second = std::move(send_again);
}

void PendingReply::answer(std::shared_ptr<const void> reply) {
  if (answered_) return;
  answered_ = true;
  write_(reply.get());
  server_->answered({request_.writer_guid(), request_.sequence_number()},
                    [write = write_, reply] { write(reply.get()); });
}

}  // namespace roci::services
