// Whatever a downlink schedule or a mission outlook holds, as long as it decodes: each view of it is text, JSON and a
// picture of bounded size, and nothing else comes out.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "ground_console/cli/outlook/outlook.hpp"
#include "ground_console/cli/report.hpp"
#include "tests/fuzz/rounds.hpp"
#include "tests/fuzz/topics/decoders.hpp"
#include "tests/fuzz/topics/sample_maker.hpp"

namespace roci::fuzz {
namespace {

namespace outlook = console::cli::outlook;

const Decoder& decoder_of(const std::string& type) {
  for (const Decoder& decoder : decoders())
    if (decoder.type == type) return decoder;
  throw std::logic_error("no decoder of " + type);
}

// The most that a picture may have for each byte of its sample, and besides:
// a row is a few shapes with their attributes.
constexpr std::size_t kLargestPicture = 8U << 20U;

void expect_picture(const std::string& picture) {
  ASSERT_TRUE(picture.starts_with("<svg ")) << picture.substr(0, 80);
  ASSERT_TRUE(picture.ends_with("</svg>\n"));
  ASSERT_LE(picture.size(), kLargestPicture);
  for (const char c : picture) ASSERT_FALSE(c == '\x1b' || c == '\0');
}

void expect_words(const std::string& text) {
  for (const char c : text) ASSERT_FALSE(c == '\x1b') << text;
}

// Makes samples, a quarter of them damaged, and shows each that decodes; returns how many did.
template <class Sample, class Show>
int shown(const std::string& type, std::uint64_t seed, Show show) {
  const Decoder& decoder = decoder_of(type);
  SampleMaker maker(seed);
  int out = 0;
  for (int round = 0; round < rounds(1000); ++round) {
    MadeSample sample = maker.make(type, 1 + maker.below(12));
    const auto payload = maker.below(4) == 0 ? maker.damaged(sample) : sample.payload;
    const auto decoded = decoder.topic.codec.decode(payload);
    if (!decoded.whole) continue;
    ++out;
    show(*static_cast<const Sample*>(decoded.value.get()));
    if (testing::Test::HasFatalFailure()) {
      ADD_FAILURE() << "round " << round;
      break;
    }
  }
  return out;
}

TEST(FuzzViews, ADownlinkScheduleIsShownOrNothing) {
  const int count = shown<v1::DownlinkSchedule>("DownlinkSchedule", 31, [](const auto& schedule) {
    expect_words(outlook::downlinks_text(schedule));
    expect_words(console::cli::json_text(outlook::downlinks_json(schedule)));
    expect_picture(outlook::downlinks_svg(schedule));
  });
  EXPECT_GT(count, rounds(1000) / 2);
}

TEST(FuzzViews, AMissionOutlookIsShownOrNothing) {
  const int count = shown<v1::MissionOutlook>("MissionOutlook", 37, [](const auto& told) {
    expect_words(outlook::utility_text(told) + outlook::chains_text(told) + outlook::energy_text(told) +
                 outlook::subway_text(told));
    for (const auto& json : {outlook::utility_json(told), outlook::chains_json(told),
                             outlook::energy_json(told), outlook::subway_json(told)})
      expect_words(console::cli::json_text(json));
    for (const std::string& picture : {outlook::utility_svg(told), outlook::chains_svg(told),
                                       outlook::energy_svg(told), outlook::subway_svg(told)})
      expect_picture(picture);
  });
  EXPECT_GT(count, rounds(1000) / 2);
}

}  // namespace
}  // namespace roci::fuzz
