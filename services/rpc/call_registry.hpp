// The registry holds the calls of one node: one table and one server for each procedure, by the name of its
// request topic.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "services/rpc/pending_calls.hpp"
#include "services/rpc/reply_cache.hpp"

namespace roci::services::rpc {

/// Holds tables and servers, which are null until they are made.
class CallRegistry {
 public:
  std::shared_ptr<PendingCalls>& table(const std::string& procedure) { return tables_[procedure]; }
  std::shared_ptr<ReplyCache>& server(const std::string& procedure) { return servers_[procedure]; }

 private:
  std::map<std::string, std::shared_ptr<PendingCalls>> tables_;
  std::map<std::string, std::shared_ptr<ReplyCache>> servers_;
};

}  // namespace roci::services::rpc
