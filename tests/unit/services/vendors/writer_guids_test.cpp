#include "services/vendors/writer_guids.hpp"

#include <gtest/gtest.h>

namespace roci::services::vendors {
namespace {

transport::Guid guid(WriterGuids::Handle handle) {
  transport::Guid out{};
  out[0] = static_cast<std::uint8_t>(handle);
  out[1] = static_cast<std::uint8_t>(handle >> 8U);
  return out;
}

TEST(WriterGuids, KnowsWhoIsMatchedAndTheNewestOfThoseWhoLeft) {
  WriterGuids writers;
  writers.met(1, guid(1));
  constexpr WriterGuids::Handle kLast = 3000;
  for (WriterGuids::Handle writer = 2; writer <= kLast; ++writer) {
    writers.met(writer, guid(writer));
    writers.left(writer);
  }
  EXPECT_EQ(writers.size(), WriterGuids::kDeparted + 1);
  EXPECT_EQ(writers.find(1), guid(1));
  EXPECT_EQ(writers.find(2), std::nullopt);
  EXPECT_EQ(writers.find(kLast), guid(kLast));
}

TEST(WriterGuids, WhoIsMatchedAgainHasNotLeft) {
  WriterGuids writers;
  writers.met(1, guid(1));
  writers.left(1);
  writers.met(1, guid(1));
  for (WriterGuids::Handle writer = 2; writer < 1000; ++writer) {
    writers.met(writer, guid(writer));
    writers.left(writer);
  }
  EXPECT_EQ(writers.find(1), guid(1));
}

TEST(WriterGuids, WhoWasNeverMetDoesNotLeave) {
  WriterGuids writers;
  for (WriterGuids::Handle writer = 1; writer < 1000; ++writer) writers.left(writer);
  EXPECT_EQ(writers.size(), 0U);
}

}  // namespace
}  // namespace roci::services::vendors
