// Hollow commands are those whose next success is reported without being true.
#pragma once

#include <set>
#include <string>

namespace roci::sim::components {

/// Remembers of which commands the next success has no effect.
class HollowCommands {
 public:
  void add(const std::string& command) { pending_.insert(command); }
  /// Returns whether this success has no effect; the one after it has.
  bool take(const std::string& command) { return pending_.erase(command) > 0; }

 private:
  std::set<std::string> pending_;
};

}  // namespace roci::sim::components
