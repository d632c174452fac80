// The reply cache is one server of a procedure, without its types. It makes calls at-most-once (Birrell and
// Nelson, 1984): it knows which requests it has seen, their answers, and which of them were cancelled, before
// they came or after.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "roci_idl/rpc.h"

namespace roci::services::rpc {

inline constexpr std::size_t kCachedReplies = 256;

/// Lets each request be handled once.
class ReplyCache {
 public:
  using Id = std::pair<std::array<std::uint8_t, 16>, std::int64_t>;
  using SendAgain = std::function<void()>;

  /// Returns true if this request is to be handled, false if it is a duplicate; if it was answered before,
  /// the answer has gone out again.
  bool accept(const Id&);
  /// Keeps the answer, of `bytes`, for callers that ask again. Of all answers the newest kCachedReplies are kept, of
  /// these no more than kCachedReplyBytes together (bounds/limits.hpp), but always the newest one.
  void answered(const Id&, SendAgain, std::size_t bytes = 0);

  /// Returns the number of requests that were taken and are not answered; PendingReply counts them.
  std::size_t open() const { return open_; }
  void begin() { ++open_; }
  void end() { --open_; }

  void cancel(const Id&);
  /// Runs `handler` once, when this request is cancelled before its answer, or at once if it already is.
  void on_cancel(const Id&, std::function<void()> handler);

 private:
  struct Request {
    std::size_t bytes = 0;  // of the answer
    bool seen = false;
    bool cancelled = false;
    SendAgain send_again;  // empty: not answered yet
    std::function<void()> on_cancel;
  };
  Request& entry(const Id&);
  void forget_oldest();

  std::size_t open_ = 0;
  std::size_t bytes_ = 0;
  std::map<Id, Request> known_;
  std::deque<Id> order_;  // oldest first; bounds known_
};

/// Holds the duty to answer one request, with the writer that does it.
class PendingReply {
 public:
  /// Returns the size of the reply in bytes.
  using Write = std::function<std::size_t(const std::shared_ptr<const void>& reply)>;

  /// Takes on a request. With `keeps`, the answer is kept for a caller that asks again.
  PendingReply(std::shared_ptr<ReplyCache> server, const v1::SampleIdentity& request, Write write,
               bool keeps = true)
      : server_(std::move(server)), request_(request), write_(std::move(write)), keeps_(keeps) {
    server_->begin();
  }
  ~PendingReply();
  PendingReply(const PendingReply&) = delete;
  PendingReply& operator=(const PendingReply&) = delete;

  const v1::SampleIdentity& request() const { return request_; }
  /// Sends and remembers the first answer; others are ignored.
  void answer(std::shared_ptr<const void> reply);
  void on_cancel(std::function<void()> handler);

 private:
  ReplyCache::Id id() const { return {request_.writer_guid(), request_.sequence_number()}; }

  std::shared_ptr<ReplyCache> server_;
  v1::SampleIdentity request_;
  Write write_;
  bool keeps_;
  bool answered_ = false;
};

}  // namespace roci::services::rpc
