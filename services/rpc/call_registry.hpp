// The calls of one node: one table and one server for each procedure, by the name of its request topic.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "services/rpc/call_server.hpp"
#include "services/rpc/call_table.hpp"

namespace roci::services::rpc {

class CallRegistry {
 public:
  std::shared_ptr<CallTable>& table(const std::string& procedure) { return tables_[procedure]; }
  std::shared_ptr<CallServer>& server(const std::string& procedure) { return servers_[procedure]; }

 private:
  std::map<std::string, std::shared_ptr<CallTable>> tables_;
  std::map<std::string, std::shared_ptr<CallServer>> servers_;
};

}  // namespace roci::services::rpc
