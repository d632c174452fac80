#include "sim_svc/world/image_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::world {
namespace {

using ImageChange = ImageStore::Change;
using ImageState = ImageStore::State;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Image image(const std::string& id, int taken_s = 0) {
  Image out;
  out.id = id;
  out.robot = "rover";
  out.bytes = 1000;
  out.taken = temporal::seconds(taken_s);
  out.preview = {1, 2, 3};
  return out;
}

// As many images as a robot remembers, all of them sent, each taken a second after the one before it.
std::map<std::string, Image> as_many_as_are_remembered() {
  std::map<std::string, Image> out;
  for (std::size_t i = 0; i < ImageStore::kSent; ++i) {
    Image one = image("i" + std::to_string(i), static_cast<int>(i));
    one.sent = true;
    out.emplace(one.id, one);
  }
  return out;
}

TEST(ImageStore, TellsWhatHasChangedOnce) {
  ImageStore store;
  store.add(image("two"));
  store.add(image("one"));
  EXPECT_THAT(store.take_changes(),
              ElementsAre(ImageChange{"one", ImageState::stored}, ImageChange{"two", ImageState::stored}));
  EXPECT_THAT(store.take_changes(), IsEmpty());
  EXPECT_EQ(store.set_sent("two")->preview, image("two").preview);
  EXPECT_TRUE(store.find("two")->preview.empty());
  EXPECT_THAT(store.take_changes(), ElementsAre(ImageChange{"two", ImageState::sent}));
  EXPECT_FALSE(store.set_sent("three").has_value());
  EXPECT_THAT(store.take_changes(), IsEmpty());
}

TEST(ImageStore, RemembersTheNewestSentImagesAndAllThatAreNotSent) {
  ImageStore store;
  store.add(image("unsent"));
  for (std::size_t i = 0; i < ImageStore::kSent + 1000; ++i) {
    const std::string id = "i" + std::to_string(i);
    store.add(image(id));
    store.set_sent(id);
    store.take_changes();
  }
  EXPECT_EQ(store.images().size(), ImageStore::kSent + 1);
  EXPECT_NE(store.find("unsent"), nullptr);
  EXPECT_EQ(store.find("i999"), nullptr);
  EXPECT_NE(store.find("i1000"), nullptr);
}

TEST(ImageStore, AnImageThatIsTakenAgainIsNotSentAndNotForgotten) {
  ImageStore store;
  store.restore(as_many_as_are_remembered());
  store.add(image("i0"));  // the oldest
  store.add(image("next"));
  store.set_sent("next");
  store.add(image("last"));
  store.set_sent("last");
  EXPECT_FALSE(store.find("i0")->sent);
  EXPECT_EQ(store.find("i1"), nullptr);
}

// The timeline of a forgotten image ends, so that its writer and its readers may forget it too (sim_service.cpp).
TEST(World, ForgetsTheImageThatWasSentFirst) {
  WorldMemory memory;
  memory.robots["rover"].images = as_many_as_are_remembered();
  Flight run(flat_setup());
  run.world.restore(memory);
  const auto ended = [&run] {
    std::vector<std::string> out;
    for (const Output& output : run.said)
      if (const auto* one = std::get_if<Observed>(&output); one != nullptr && one->ended)
        out.push_back(one->timeline);
    return out;
  };
  run.command(temporal::seconds(2), execute("i", "camera", "image", {{"image", "new"}}));
  run.advance(temporal::seconds(1000));
  EXPECT_THAT(ended(), IsEmpty());
  run.command(temporal::seconds(1000), execute("t", "radio", "send", {{"image", "new"}}));
  run.advance(temporal::seconds(1200));
  EXPECT_EQ(run.state("rover.image.new"), (temporal::State{"sent", {}}));
  EXPECT_THAT(ended(), ElementsAre("rover.image.i0"));
  run.command(temporal::seconds(1200), execute("again", "radio", "send", {{"image", "i0"}}));
  EXPECT_EQ(run.code("again"), "no-image");
}

}  // namespace
}  // namespace roci::sim::world
