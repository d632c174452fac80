#include "services/vendors/inproc/bus.hpp"

#include <map>

#include "services/vendors/inproc/partitions.hpp"

namespace roci::services::vendors::inproc {
namespace {

// Topic and type by name, a partition in common, and a reader asks for no more than the writer offers.
bool match(const transport::EndpointDescription& writer, const transport::EndpointDescription& reader) {
  return writer.topic == reader.topic && writer.type.name == reader.type.name &&
         writer.type.keyed == reader.type.keyed && partitions_match(writer.partitions, reader.partitions) &&
         writer.qos.reliable >= reader.qos.reliable &&
         writer.qos.transient_local >= reader.qos.transient_local;
}

}  // namespace

void Bus::add(const std::shared_ptr<WriterEnd>& writer) {
  const std::lock_guard lock(mutex_);
  writers_.push_back(writer);
  for (const auto& reader : readers_) {
    if (match(writer->description(), reader->description())) writer->attach(reader);
  }
}

void Bus::add(const std::shared_ptr<ReaderEnd>& reader) {
  const std::lock_guard lock(mutex_);
  readers_.push_back(reader);
  for (const auto& writer : writers_) {
    if (match(writer->description(), reader->description())) writer->attach(reader);
  }
}

void Bus::remove(const std::shared_ptr<WriterEnd>& writer) {
  {
    const std::lock_guard lock(mutex_);
    std::erase(writers_, writer);
  }
  writer->close();
}

void Bus::remove(const std::shared_ptr<ReaderEnd>& reader) {
  {
    const std::lock_guard lock(mutex_);
    std::erase(readers_, reader);
    for (const auto& writer : writers_) writer->detach(reader);
  }
  reader->close();
}

std::uint64_t Bus::next_id() {
  const std::lock_guard lock(mutex_);
  return ++last_id_;
}

std::shared_ptr<Bus> bus_of_domain(int domain) {
  static std::mutex mutex;
  static std::map<int, std::weak_ptr<Bus>> buses;
  const std::lock_guard lock(mutex);
  auto bus = buses[domain].lock();
  if (!bus) buses[domain] = bus = std::make_shared<Bus>();
  return bus;
}

}  // namespace roci::services::vendors::inproc
