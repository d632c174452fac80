// What a link report says is done about each sample that did not arrive.
#include "services/process/link_report.hpp"

#include <gtest/gtest.h>

#include "services/topics/topics.hpp"

namespace roci::services::process {
namespace {

std::string effect_of(const std::string& topic, link::Fate fate = link::Fate::lost) {
  link::LostSample sample;
  sample.topic = topic;
  sample.fate = fate;
  return process::effect_of(sample);
}

TEST(LinkReport, NamesWhatIsDoneAboutALostSample) {
  EXPECT_EQ(effect_of(topics::command.name), "asked for");
  EXPECT_EQ(effect_of(topics::path_request.request.name), "called again");
  EXPECT_EQ(effect_of(topics::path_request.reply.name), "called again");
  EXPECT_EQ(effect_of(topics::plan_delta.name), "made up for by a newer version");
  EXPECT_EQ(effect_of(topics::event.name), "never heard");
}

// A cancel repairs nothing when it is lost, and nothing needs repair: the answer comes, and nobody waits for it.
TEST(LinkReport, ACancelThatIsLostIsAnsweredInVain) {
  EXPECT_EQ(effect_of(topics::call_cancel.name), "answered in vain");
}

TEST(LinkReport, WhatTheLinkSendsAgainOrReplacesIsNoLossWhateverItsTopic) {
  for (const std::string topic : {topics::command.name, topics::call_cancel.name, topics::event.name}) {
    EXPECT_EQ(effect_of(topic, link::Fate::repeated), "sent again");
    EXPECT_EQ(effect_of(topic, link::Fate::superseded), "superseded");
  }
}

}  // namespace
}  // namespace roci::services::process
