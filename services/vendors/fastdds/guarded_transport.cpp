#include "services/vendors/fastdds/guarded_transport.hpp"

#include <fastrtps/utils/IPLocator.h>

#include <algorithm>
#include <fastdds/rtps/common/LocatorList.hpp>
#include <mutex>
#include <span>
#include <vector>

#include "services/vendors/guard/assembly.hpp"
#include "services/vendors/guard/message.hpp"

namespace roci::services::vendors::fastdds {

namespace transports = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::octet;

namespace {

/// The submessage 0x80 at the end of each message of Debian's build, with its header.
constexpr std::uint32_t kStatisticsSize = 60;

/// Bounds a datagram (UDP over IPv4).
constexpr std::size_t kMostBytes = 65'507;

/// Names eProsima in the header of its messages.
constexpr std::uint16_t kOwnVendor = 0x010f;

std::optional<guard::Source> source_of(const Locator_t& locator) {
  if (locator.kind != LOCATOR_KIND_UDPv4) return std::nullopt;
  std::uint32_t address = 0;
  for (std::size_t i = 12; i < 16; ++i) address = address << 8 | locator.address[i];
  return guard::Source{address, IPLocator::getPhysicalPort(locator)};
}

class GuardedTransport : public transports::ChainingTransport {
 public:
  GuardedTransport(const transports::ChainingTransportDescriptor& descriptor,
                   std::shared_ptr<guard::Guard> guard, std::shared_ptr<KeySlots> slots)
      : ChainingTransport(descriptor),
        guard_(std::move(guard)),
        slots_(std::move(slots)),
        descriptor_(descriptor.low_level_descriptor) {}

  transports::TransportDescriptorInterface* get_configuration() override { return descriptor_.get(); }

  bool send(eprosima::fastrtps::rtps::SenderResource* sender, const octet* bytes, std::uint32_t size,
            transports::LocatorsIterator* begin, transports::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& deadline) override {
    if (!guard_->is_secure()) return send_plain(sender, {bytes, size}, begin, end, deadline);
    eprosima::fastrtps::rtps::LocatorList_t admitted;
    for (; *begin != *end; ++*begin) {
      const auto destination = source_of(**begin);
      if (!destination || !guard_->keeps_back({bytes, size}, *destination)) admitted.push_back(**begin);
    }
    if (admitted.empty()) return true;
    eprosima::fastrtps::rtps::Locators first(admitted.begin()), last(admitted.end());
    return sender->send(bytes, size, &first, &last, deadline);
  }

  // The bytes are in the receiving thread's own buffer; the vendor, too, changes them there.
  void receive(transports::TransportReceiverInterface* next, const octet* bytes, std::uint32_t size,
               const Locator_t& local, const Locator_t& remote) override {
    const std::span<octet> datagram{const_cast<octet*>(bytes), size};
    std::size_t left = guard_->admit(datagram, source_of(remote));
    if (left == 0) return;
    if (slots_) {
      guard::for_each_key_hash(datagram.first(left), [this](std::span<octet, 16> hash) {
        KeySlots::KeyHash key;
        std::ranges::copy(hash, key.begin());
        std::ranges::copy(slots_->handle_of(key), hash.begin());
      });
    }
    std::vector<std::vector<octet>> whole;
    {
      const std::lock_guard lock(mutex_);
      left = assembly_.take(datagram.first(left), kOwnVendor, whole);
    }
    for (const std::vector<octet>& sample : whole)
      next->OnDataReceived(sample.data(), static_cast<std::uint32_t>(sample.size()), local, remote);
    if (left > 0) next->OnDataReceived(bytes, static_cast<std::uint32_t>(left), local, remote);
  }

 private:
  bool send_plain(eprosima::fastrtps::rtps::SenderResource* sender, std::span<const octet> message,
                  transports::LocatorsIterator* begin, transports::LocatorsIterator* end,
                  const std::chrono::steady_clock::time_point& deadline) {
    guard_->sent(message);
    std::vector<octet> other;
    {
      const std::lock_guard lock(mutex_);
      other = assembly_.with_requests(message);
    }
    // What has no room is asked for behind the next acknowledgement.
    if (!other.empty() && other.size() <= kMostBytes) message = other;
    return sender->send(message.data(), static_cast<std::uint32_t>(message.size()), begin, end, deadline);
  }

  const std::shared_ptr<guard::Guard> guard_;
  const std::shared_ptr<KeySlots> slots_;
  const std::shared_ptr<transports::TransportDescriptorInterface> descriptor_;
  std::mutex mutex_;
  guard::Assembly assembly_;
};

class GuardedDescriptor : public transports::ChainingTransportDescriptor {
 public:
  GuardedDescriptor(std::shared_ptr<transports::TransportDescriptorInterface> udp,
                    std::shared_ptr<guard::Guard> guard, std::shared_ptr<KeySlots> slots)
      : ChainingTransportDescriptor(std::move(udp)), guard_(std::move(guard)), slots_(std::move(slots)) {}
  transports::TransportInterface* create_transport() const override {
    return new GuardedTransport(*this, guard_, slots_);
  }
  /// Fast DDS fills messages up to this size and then adds its statistics, for which it keeps no room.
  std::uint32_t max_message_size() const override {
    return ChainingTransportDescriptor::max_message_size() - kStatisticsSize;
  }

 private:
  const std::shared_ptr<guard::Guard> guard_;
  const std::shared_ptr<KeySlots> slots_;
};

}  // namespace

std::shared_ptr<transports::TransportDescriptorInterface> guarded(
    std::shared_ptr<transports::TransportDescriptorInterface> udp, std::shared_ptr<guard::Guard> guard,
    std::shared_ptr<KeySlots> slots) {
  return std::make_shared<GuardedDescriptor>(std::move(udp), std::move(guard), std::move(slots));
}

}  // namespace roci::services::vendors::fastdds
