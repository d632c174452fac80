// A transport that hears nobody and locks up as ROCI_LOCKED says: "write" (a write of the second second never
// returns) or "end" (its destructor never does).
#include "services/transport/transport.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string>

namespace roci::scenario {
namespace {

constexpr int kGoodWrites = 8;  // heartbeats come four times a second

bool locks_in(const char* what) {
  const char* where = std::getenv("ROCI_LOCKED");
  return where != nullptr && std::string(where) == what;
}

[[noreturn]] void lock_up() {
  for (;;) pause();
}

class LockedWriter : public services::transport::Writer {
 public:
  bool write(std::span<const std::uint8_t>) override {
    if (locks_in("write") && ++writes_ > kGoodWrites) lock_up();
    return true;
  }
  bool dispose(std::span<const std::uint8_t>) override { return true; }
  services::transport::Guid guid() const override { return {}; }
  int matched_readers() const override { return 0; }

 private:
  int writes_ = 0;
};

class LockedReader : public services::transport::Reader {
 public:
  int matched_writers() const override { return 0; }
};

class LockedTransport : public services::transport::Transport {
 public:
  ~LockedTransport() override {
    if (locks_in("end")) lock_up();
  }
  std::string_view vendor() const override { return "locked"; }
  std::unique_ptr<services::transport::Writer> create_writer(const services::transport::EndpointDescription&,
                                                             services::transport::WriterEvents) override {
    return std::make_unique<LockedWriter>();
  }
  std::unique_ptr<services::transport::Reader> create_reader(const services::transport::EndpointDescription&,
                                                             services::transport::ReaderEvents) override {
    return std::make_unique<LockedReader>();
  }
  std::string announcement() const override { return {}; }
  std::optional<services::transport::Participant> participant_of(const services::transport::Guid&) override {
    return std::nullopt;
  }
  bool speaks_as(const services::transport::Guid&, std::string_view) const override { return true; }
};

}  // namespace
}  // namespace roci::scenario

extern "C" std::unique_ptr<roci::services::transport::Transport> roci_create_transport(
    const roci::services::transport::TransportOptions&) {
  return std::make_unique<roci::scenario::LockedTransport>();
}
