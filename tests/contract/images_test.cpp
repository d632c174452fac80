// science_svc as a process, on images that no camera makes and on those that one does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "services/clock/wall.hpp"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/transport/plug_ins.hpp"
#include "tests/contract/support/child_process.hpp"

namespace roci::services::contract {
namespace {

using testing::Contains;
using testing::HasSubstr;

class Images : public testing::TestWithParam<std::string> {
 protected:
  Images() {
    node::NodeOptions options;
    options.name = "sim_svc";
    options.run = "test";
    options.epoch_unix_us = epoch_;
    options.vendor = GetParam();
    transport::TransportOptions transport;
    transport.domain = domain_.id();
    transport.participant = "sim_svc";
    node_.emplace(options, transport::open_transport(GetParam(), transport));
    subscribe(*node_, topics::event, [this](const v1::Event& event) {
      if (event.code() == "image.unreadable") told_.push_back(event.text());
    });
    subscribe(*node_, topics::goal, [this](const v1::Goal& goal) { goals_.push_back(goal); });
    subscribe(*node_, topics::data_product, [this](const v1::DataProduct& product) {
      if (product.product_kind() == "crop") crops_.push_back(product);
    });
    subscribe(*node_, topics::heartbeat, [this](const v1::Heartbeat& beat) {
      if (beat.service() == "science_svc") ++beats_;
    });
    products_.emplace(advertise(*node_, topics::data_product));
    service_.emplace(std::vector<std::string>{
        ROCI_BINARY_DIR "/bin/science_svc", "--mission", ROCI_SOURCE_DIR "/missions/planetary", "--scenario",
        "opportunistic", "--clock", "live", "--epoch", std::to_string(epoch_ / 1'000'000), "--run", "test",
        "--robot", "rover", "--dds", GetParam(), "--domain", std::to_string(domain_.id())});
  }

  bool until(const std::function<bool()>& so) {
    const auto end = clock::wall_now() + clock::wall_seconds(60);
    while (!so() && clock::wall_now() < end) node_->spin_once(std::chrono::milliseconds(20));
    return so();
  }

  void publish(const std::string& id, const std::string& file) {
    v1::DataProduct out;
    out.id(id);
    out.product_kind("image");
    out.fate(v1::PRODUCT_STORED);
    out.created_us(node_->now().count() + 3'600'000'000);
    out.x_m(100);
    out.y_m(100);
    out.preview({file.begin(), file.end()});
    products_->write(out);
  }

  // Grey ground; with a light square on it.
  static std::string ground(std::uint64_t seed, bool odd) {
    std::mt19937_64 random(seed);
    std::string out = "P5\n96 64\n255\n";
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 96; ++x)
        out += static_cast<char>((odd && x >= 42 && x < 54 && y >= 32 && y < 44 ? 235 : 110) +
                                 static_cast<int>(random() % 15));
    return out;
  }

  process::DomainClaim domain_;
  std::int64_t epoch_ = clock::unix_us() / 1'000'000 * 1'000'000;
  std::optional<Node> node_;
  std::optional<Publisher<v1::DataProduct>> products_;
  std::optional<ChildProcess> service_;
  std::vector<std::string> told_;
  std::vector<v1::Goal> goals_;
  std::vector<v1::DataProduct> crops_;
  int beats_ = 0;
};

TEST_P(Images, BrokenEmptyAndHugeOnesAreEventsAndNothingMore) {
  ASSERT_TRUE(until([this] { return beats_ > 0; }));
  const std::vector<std::pair<std::string, std::string>> bad{
      {"no-image", "\x89PNG and more"},
      {"empty", ""},
      {"nothing-to-see", "P5\n0 0\n255\n"},
      {"cut", ground(1, true).substr(0, 3000)},
      {"claims-100-mb", "P5\n10000 10000\n255\n" + std::string(100, 'x')},
      {"deep", "P5\n64 64\n65535\n" + std::string(64 * 64 * 2, '\1')},
      {"huge", "P5\n2000 1500\n255\n" + std::string(3'000'000, 'x')}};
  for (const auto& [id, file] : bad) publish(id, file);
  EXPECT_TRUE(until([&] { return told_.size() >= bad.size(); })) << testing::PrintToString(told_);
  for (const auto& [id, file] : bad) EXPECT_THAT(told_, Contains(HasSubstr(id + ":")));
  EXPECT_TRUE(goals_.empty());
  for (std::uint64_t i = 0; i < 4; ++i) publish("plain-" + std::to_string(i), ground(i, false));
  publish("odd", ground(9, true));
  EXPECT_TRUE(until([this] { return !goals_.empty() && !crops_.empty(); })) << "it goes on looking";
  ASSERT_FALSE(crops_.empty());
  EXPECT_EQ(crops_[0].source(), "odd");
  EXPECT_EQ(told_.size(), bad.size());
}

INSTANTIATE_TEST_SUITE_P(Vendors, Images, testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace roci::services::contract
