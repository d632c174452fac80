// The bus is where the inproc participants of one domain meet.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "services/transport/transport.hpp"
#include "services/vendors/inproc/reader_end.hpp"
#include "services/vendors/inproc/writer_end.hpp"
#include "services/vendors/participant_table.hpp"

namespace roci::services::vendors::inproc {

/// Matches writers with readers as DDS discovery does.
class Bus {
 public:
  void add(const std::shared_ptr<WriterEnd>&);
  void add(const std::shared_ptr<ReaderEnd>&);
  void remove(const std::shared_ptr<WriterEnd>&);
  void remove(const std::shared_ptr<ReaderEnd>&);

  ParticipantTable& participants() { return participants_; }

  /// Returns a number that is unique in this process, from 1.
  std::uint64_t next_id();

 private:
  ParticipantTable participants_;
  std::mutex mutex_;
  std::uint64_t last_id_ = 0;
  std::vector<std::shared_ptr<WriterEnd>> writers_;
  std::vector<std::shared_ptr<ReaderEnd>> readers_;
};

/// Returns the bus of a domain, which lives as long as one of its participants holds it.
std::shared_ptr<Bus> bus_of_domain(int domain);

}  // namespace roci::services::vendors::inproc
