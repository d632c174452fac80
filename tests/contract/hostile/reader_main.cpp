// contract-reader VENDOR DOMAIN: a participant of ours with a reader on every topic, which decodes what arrives. It
// ends with its input. Standard output, one line each: ready | matched TOPIC (two writers)
// | matched all | goal ISSUER ID.
#include <atomic>
#include <iostream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "services/transport/plug_ins.hpp"
#include "services/transport/type_support.hpp"
#include "tests/contract/hostile/every_topic.hpp"

namespace roci::services::contract::hostile {
namespace {

void say(const std::string& line) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  std::cout << line << std::endl;
}

class Readers {
 public:
  Readers(const std::string& vendor, int domain)
      : transport_(transport::open_transport(vendor, {.domain = domain})) {
    for_each_topic([this]<class T>(const topics::Topic<T>& topic) { open(topic); });
  }

 private:
  template <class T>
  void open(const topics::Topic<T>& topic) {
    transport::EndpointDescription endpoint{
        topic.name, transport::describe_type<T>(topic.type_name),
        transport::reader_qos(topic.qos, topic.clocking, clock::ClockMode::live),
        transport::partitions_of(topic.scope, "")};
    ++topics_;
    auto seen = std::make_shared<std::atomic<bool>>(false);
    const std::string name = topic.name;
    const auto on_matched = [this, seen, name](int count) {
      if (count < 2 || seen->exchange(true)) return;
      say("matched " + name);
      if (++matched_ == topics_) say("matched all");
    };
    readers_.push_back(transport_->create_reader(
        endpoint, {[](transport::Sample&& sample) { decode<T>(sample); }, on_matched}));
  }

  template <class T>
  static void decode(const transport::Sample& sample) {
    T value;
    if (sample.kind != transport::SampleKind::data) {
      if (!transport::deserialize_key(sample.payload, value)) say("undecodable end");
      return;
    }
    if (!transport::deserialize(sample.payload, value)) return;
    if constexpr (std::is_same_v<T, v1::Goal>) say("goal " + value.issuer() + " " + value.id());
  }

  std::unique_ptr<transport::Transport> transport_;
  std::atomic<int> topics_ = 0, matched_ = 0;
  std::vector<std::unique_ptr<transport::Reader>> readers_;
};

}  // namespace
}  // namespace roci::services::contract::hostile

int main(int argc, char** argv) {
  using namespace roci::services::contract::hostile;
  if (argc != 3) return 2;
  const Readers readers(argv[1], std::stoi(argv[2]));
  say("ready");
  for (std::string line; std::getline(std::cin, line);) {
  }
  return 0;
}
