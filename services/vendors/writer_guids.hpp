// This table has the writers that a reader has met, by the handles that its vendor gives them: the end of an instance
// may come after its writer has gone.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>

#include "services/transport/transport.hpp"

namespace roci::services::vendors {

/// Knows all matched writers, and of those that left the newest kDeparted, since writers come and go without end.
class WriterGuids {
 public:
  using Handle = std::uint64_t;  ///< the vendor's

  static constexpr std::size_t kDeparted = 256;

  std::optional<transport::Guid> find(Handle writer) const;
  void met(Handle writer, const transport::Guid& guid);
  void left(Handle writer);
  std::size_t size() const { return guids_.size(); }

 private:
  std::unordered_map<Handle, transport::Guid> guids_;
  std::deque<Handle> departed_;  // the newest last
};

}  // namespace roci::services::vendors
