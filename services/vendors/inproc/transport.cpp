// The inproc transport: participants of one process, on any threads, that meet by domain id. No network.
#include "services/transport/transport.hpp"

#include <map>
#include <mutex>

#include "services/transport/forgets_instances.hpp"
#include "services/vendors/inproc/bus.hpp"

namespace roci::services::vendors::inproc {
namespace {

// As in DDS, the endpoints of a participant share its first 12 bytes; here the domain and the participant's id.
transport::Guid guid_of(int domain, std::uint64_t participant, std::uint64_t endpoint) {
  transport::Guid guid{};
  for (std::size_t i = 0; i < 4; ++i) guid[i] = static_cast<std::uint8_t>(domain >> (24 - 8 * i));
  for (std::size_t i = 0; i < 8; ++i) guid[4 + i] = static_cast<std::uint8_t>(participant >> (56 - 8 * i));
  for (std::size_t i = 0; i < 4; ++i) guid[12 + i] = static_cast<std::uint8_t>(endpoint >> (24 - 8 * i));
  return guid;
}

class InprocWriter : public transport::Writer, public transport::ForgetsInstances {
 public:
  InprocWriter(std::shared_ptr<Bus> bus, std::shared_ptr<WriterEnd> end)
      : bus_(std::move(bus)), end_(std::move(end)) {}
  ~InprocWriter() override { bus_->remove(end_); }
  bool write(std::span<const std::uint8_t> payload) override { return end_->write(payload); }
  bool dispose(std::span<const std::uint8_t> payload) override { return end_->dispose(payload); }
  bool forget(std::span<const std::uint8_t> payload) override { return end_->dispose(payload); }
  transport::Guid guid() const override { return end_->guid(); }
  int matched_readers() const override { return end_->matched_readers(); }

 private:
  std::shared_ptr<Bus> bus_;
  std::shared_ptr<WriterEnd> end_;
};

class InprocReader : public transport::Reader {
 public:
  InprocReader(std::shared_ptr<Bus> bus, std::shared_ptr<ReaderEnd> end)
      : bus_(std::move(bus)), end_(std::move(end)) {}
  ~InprocReader() override { bus_->remove(end_); }
  int matched_writers() const override { return end_->matched_writers(); }

 private:
  std::shared_ptr<Bus> bus_;
  std::shared_ptr<ReaderEnd> end_;
};

class InprocTransport : public transport::Transport {
 public:
  explicit InprocTransport(const transport::TransportOptions& options)
      : domain_(options.domain),
        announcement_(options.announcement.value_or("")),
        bus_(bus_of_domain(options.domain)),
        participant_(bus_->next_id()) {
    bus_->participants().add(guid_of(domain_, participant_, 0), {options.participant, announcement_});
  }

  std::string_view vendor() const override { return "inproc"; }

  std::unique_ptr<transport::Writer> create_writer(const transport::EndpointDescription& description,
                                                   transport::WriterEvents events) override {
    check_type(description);
    const auto id = bus_->next_id();
    auto end = std::make_shared<WriterEnd>(description, std::move(events), dispatcher_, id,
                                           guid_of(domain_, participant_, id));
    auto writer = std::make_unique<InprocWriter>(bus_, end);
    bus_->add(end);
    return writer;
  }

  std::unique_ptr<transport::Reader> create_reader(const transport::EndpointDescription& description,
                                                   transport::ReaderEvents events) override {
    check_type(description);
    const auto id = bus_->next_id();
    auto end = std::make_shared<ReaderEnd>(description, std::move(events), dispatcher_, id,
                                           guid_of(domain_, participant_, id));
    auto reader = std::make_unique<InprocReader>(bus_, end);
    bus_->add(end);
    return reader;
  }

  std::string announcement() const override { return announcement_; }
  std::optional<transport::Participant> participant_of(const transport::Guid& guid) override {
    return bus_->participants().find(guid);
  }
  bool speaks_as(const transport::Guid&, std::string_view) const override { return true; }

 private:
  void check_type(const transport::EndpointDescription& description) {
    const std::lock_guard lock(mutex_);
    const auto& name = types_.try_emplace(description.topic, description.type.name).first->second;
    if (name != description.type.name) {
      throw transport::TransportError("topic " + description.topic + " has the type " + name +
                                      " in this participant, so it cannot have " + description.type.name +
                                      " too");
    }
  }

  const int domain_;
  const std::string announcement_;
  const std::shared_ptr<Bus> bus_;
  const std::uint64_t participant_;
  std::mutex mutex_;
  std::map<std::string, std::string> types_;  // of the topics
  const std::shared_ptr<Dispatcher> dispatcher_ = std::make_shared<Dispatcher>();
};

}  // namespace
}  // namespace roci::services::vendors::inproc

extern "C" std::unique_ptr<roci::services::transport::Transport> roci_create_transport(
    const roci::services::transport::TransportOptions& options) {
  if (options.credentials)
    throw roci::services::transport::TransportError(
        "inproc has no network that could be secured; leave out --secure");
  return std::make_unique<roci::services::vendors::inproc::InprocTransport>(options);
}
