#include "services/transport/lossy_transport.hpp"

#include <charconv>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <random>
#include <stop_token>
#include <thread>

#include "services/clock/wall.hpp"

namespace roci::services::transport {
namespace {

using WallTime = clock::WallTime;

// FNV-1a: the same on every machine, unlike std::hash.
std::uint64_t hash_of(std::string_view text, std::uint64_t seed) {
  std::uint64_t hash = 14695981039346656037ULL ^ seed;
  for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211ULL;
  return hash;
}

// One delay thread per reader; it ends before the reader's last callback is over.
class DelayedReader : public Reader {
 public:
  DelayedReader(Transport& transport, const EndpointDescription& endpoint, ReaderEvents events,
                const Loss& loss)
      : loss_(loss),
        topic_seed_(hash_of(endpoint.topic, loss.seed)),
        on_sample_(std::move(events.on_sample)) {
    events.on_sample = [this](Sample&& sample) { take(std::move(sample)); };
    thread_ = std::jthread([this](const std::stop_token& stop) { deliver(stop); });
    reader_ = transport.create_reader(endpoint, std::move(events));
  }
  int matched_writers() const override { return reader_->matched_writers(); }

 private:
  struct Late {
    clock::WallTime due;
    Sample sample;
  };

  void take(Sample&& sample) {
    const std::lock_guard lock(mutex_);
    auto& fate = fates_.try_emplace(sample.writer, topic_seed_).first->second;
    const double draw = static_cast<double>(fate() >> 11) * 0x1.0p-53;
    if (sample.kind == SampleKind::data && draw < loss_.fraction) return;
    late_.push_back({clock::wall_now() + loss_.delay, std::move(sample)});
    changed_.notify_one();
  }

  void deliver(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return !late_.empty(); })) {
      const auto due = late_.front().due;
      changed_.wait_until(lock, stop, due, [] { return false; });
      if (stop.stop_requested()) return;
      Sample sample = std::move(late_.front().sample);
      late_.pop_front();
      lock.unlock();
      on_sample_(std::move(sample));
      lock.lock();
    }
  }

  const Loss loss_;
  const std::uint64_t topic_seed_;
  const std::function<void(Sample&&)> on_sample_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Late> late_;
  std::map<Guid, std::mt19937_64> fates_;
  std::jthread thread_;
  std::unique_ptr<Reader> reader_;
};

class LossyTransport : public Transport {
 public:
  LossyTransport(std::unique_ptr<Transport> inner, const Loss& loss)
      : inner_(std::move(inner)), loss_(loss) {}
  std::string_view vendor() const override { return inner_->vendor(); }
  std::unique_ptr<Writer> create_writer(const EndpointDescription& endpoint, WriterEvents events) override {
    return inner_->create_writer(endpoint, std::move(events));
  }
  std::unique_ptr<Reader> create_reader(const EndpointDescription& endpoint, ReaderEvents events) override {
    if (endpoint.qos.reliable) return inner_->create_reader(endpoint, std::move(events));
    return std::make_unique<DelayedReader>(*inner_, endpoint, std::move(events), loss_);
  }
  std::string announcement() const override { return inner_->announcement(); }
  std::optional<Participant> participant_of(const Guid& guid) override {
    return inner_->participant_of(guid);
  }

 private:
  std::unique_ptr<Transport> inner_;
  Loss loss_;
};

template <class Number>
bool parse_field(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

Loss parse_loss(std::string_view text) {
  const auto first = text.find(':');
  const auto second = first == text.npos ? text.npos : text.find(':', first + 1);
  Loss loss;
  std::int64_t delay_ms = 0;
  const bool read = second != text.npos && parse_field(text.substr(0, first), loss.fraction) &&
                    parse_field(text.substr(first + 1, second - first - 1), loss.seed) &&
                    parse_field(text.substr(second + 1), delay_ms);
  if (!read || !(loss.fraction >= 0 && loss.fraction <= 1) || delay_ms < 0) {
    throw TransportError("ROCI_LOSS is \"" + std::string(text) +
                         "\"; expected fraction:seed:delay_ms with a fraction from 0 to 1, e.g. 0.2:7:30");
  }
  loss.delay = std::chrono::milliseconds(delay_ms);
  return loss;
}

std::unique_ptr<Transport> make_lossy(std::unique_ptr<Transport> inner, const Loss& loss) {
  return std::make_unique<LossyTransport>(std::move(inner), loss);
}

}  // namespace roci::services::transport
