#include "services/vendors/inproc/bus.hpp"

#include <map>

namespace roci::services::vendors::inproc {
namespace {

// Topic and type by name, and a reader asks for no more than the writer offers.
bool match(const transport::EndpointDescription& writer, const transport::EndpointDescription& reader) {
  return writer.topic == reader.topic && writer.type.name == reader.type.name &&
         writer.type.keyed == reader.type.keyed && writer.qos.reliable >= reader.qos.reliable &&
         writer.qos.transient_local >= reader.qos.transient_local;
}

}  // namespace

void Bus::add(const std::string& partition, const std::shared_ptr<WriterEnd>& writer) {
  const std::lock_guard lock(mutex_);
  writers_.push_back({partition, writer});
  for (const auto& reader : readers_) {
    if (reader.partition == partition && match(writer->description(), reader.end->description())) {
      writer->attach(reader.end);
    }
  }
}

void Bus::add(const std::string& partition, const std::shared_ptr<ReaderEnd>& reader) {
  const std::lock_guard lock(mutex_);
  readers_.push_back({partition, reader});
  for (const auto& writer : writers_) {
    if (writer.partition == partition && match(writer.end->description(), reader->description())) {
      writer.end->attach(reader);
    }
  }
}

void Bus::remove(const std::shared_ptr<WriterEnd>& writer) {
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(writers_, [&writer](const auto& entry) { return entry.end == writer; });
  }
  writer->close();
}

void Bus::remove(const std::shared_ptr<ReaderEnd>& reader) {
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(readers_, [&reader](const auto& entry) { return entry.end == reader; });
    for (const auto& writer : writers_) writer.end->detach(reader);
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
