// What `roci order` makes of its arguments, and what it prints.
#include "ground_console/cli/orders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace roci::console::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string complaint(const OrderArguments& arguments) {
  try {
    order_of(arguments);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Orders, AValueIsATruthANumberOrAState) {
  OrderArguments set;
  set.kind = v1::ORDER_SET_VALUE;
  set.target = "rover.go";
  set.value = {"true"};
  EXPECT_EQ(order_of(set).content().kind(), v1::VALUE_BOOLEAN);
  EXPECT_TRUE(order_of(set).content().truth());
  set.value = {"-2.5"};
  EXPECT_EQ(order_of(set).content().kind(), v1::VALUE_NUMBER);
  EXPECT_EQ(order_of(set).content().number(), -2.5);
  set.value = {"going-to", "wp-2"};
  EXPECT_EQ(order_of(set).content().kind(), v1::VALUE_STATE);
  EXPECT_EQ(order_of(set).content().state(), "going-to");
  EXPECT_THAT(order_of(set).content().arguments(), ElementsAre("wp-2"));
}

TEST(Orders, AFolderIsNoContentOfAnUpload) {
  OrderArguments upload;
  upload.kind = v1::ORDER_UPLOAD;
  upload.file = std::filesystem::temp_directory_path().string();
  EXPECT_THAT(complaint(upload), HasSubstr("name a file with the new content"));
}

TEST(Orders, ALevelIsOneOfFour) {
  OrderArguments autonomy;
  autonomy.kind = v1::ORDER_AUTONOMY;
  autonomy.level = "E2";
  EXPECT_EQ(order_of(autonomy).autonomy(), v1::AUTONOMY_E2);
  autonomy.level = "E5";
  EXPECT_THAT(complaint(autonomy), HasSubstr("unknown level 'E5'; one of: E1 (each activity is approved)"));
}

TEST(Orders, ACommandIsAnApprovalWithItsContent) {
  OrderArguments command;
  command.kind = v1::ORDER_APPROVE;
  command.target = "scout";
  command.command = "Scout";
  command.command_arguments = {"from=w0", "to="};
  const v1::Order order = order_of(command);
  EXPECT_EQ(order.target(), "scout");
  EXPECT_EQ(order.content().kind(), v1::VALUE_STATE);
  EXPECT_EQ(order.content().state(), "Scout");
  EXPECT_THAT(order.content().arguments(), ElementsAre("from=w0", "to="));
  command.command_arguments = {"w0"};
  EXPECT_THAT(complaint(command), HasSubstr("argument 'w0' is no NAME=VALUE"));
}

TEST(Orders, AnUploadIsTheFilesContentWithItsChecksum) {
  const auto file = std::filesystem::temp_directory_path() / ("roci_upload_" + std::to_string(::getpid()));
  std::ofstream(file) << "123456789";
  OrderArguments upload;
  upload.kind = v1::ORDER_UPLOAD;
  upload.target = "contingencies.wipe";
  upload.file = file;
  const v1::Order order = order_of(upload);
  std::filesystem::remove(file);
  EXPECT_EQ(std::string(order.upload().begin(), order.upload().end()), "123456789");
  EXPECT_EQ(order.checksum(), 0xCBF43926U) << "the check value of CRC-32";
  EXPECT_THAT(complaint(upload), HasSubstr("cannot read"));
}

TEST(Orders, AStageAndADecisionAreALineEach) {
  v1::OrderStatus status;
  status.issuer("ground");
  status.id("7");
  status.stage(v1::ORDER_APPLIED);
  status.plan_version(3);
  EXPECT_EQ(stage_line(status), "ground/7  applied in plan 3");
  status.stage(v1::ORDER_REFUSED);
  status.reason("nothing is held");
  EXPECT_EQ(stage_line(status), "ground/7  refused: nothing is held");
  v1::Decision decision;
  decision.id("way");
  decision.choices({"left", "right"});
  decision.resolver("ground");
  decision.answer_before_us(1200000000);
  EXPECT_EQ(decision_line(decision), "way: left or right? asked of ground, before 00:20:00");
  decision.choices({});
  decision.answer_before_us(-1);
  EXPECT_EQ(decision_line(decision), "way: a value? asked of ground");
}

}  // namespace
}  // namespace roci::console::cli
