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

TEST(ImageStore, GivesThePictureAwayWithoutACopy) {
  ImageStore store;
  store.add(image("one"));
  const std::uint8_t* const picture = store.find("one")->preview.data();
  EXPECT_EQ(store.set_sent("one")->preview.data(), picture);
  EXPECT_EQ(store.find("one")->preview.capacity(), 0U);
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

TEST(ImageStore, HasRoomForSoManyImagesThatAreNotSent) {
  ImageStore store;
  for (std::size_t i = 0; i < ImageStore::kStored; ++i) {
    ASSERT_TRUE(store.has_room_for("next"));
    store.add(image("i" + std::to_string(i)));
  }
  EXPECT_FALSE(store.has_room_for("next"));
  EXPECT_TRUE(store.has_room_for("i0")) << "it takes the place of the earlier one";
  store.set_sent("i0");
  EXPECT_TRUE(store.has_room_for("next"));
  store.add(image("next"));
  EXPECT_FALSE(store.has_room_for("i0")) << "it would be one that is not sent again";
}

// An image whose goal was taken back is never sent, and others come.
TEST(World, ACameraTakesNoImageForWhichThereIsNoRoom) {
  WorldMemory memory;
  for (std::size_t i = 0; i < ImageStore::kStored - 1; ++i) {
    Image one = image("i" + std::to_string(i));
    memory.robots["rover"].images.emplace(one.id, one);
  }
  Flight run(flat_setup());
  run.world.restore(memory);
  run.command(temporal::seconds(2), execute("one", "camera", "image", {{"image", "one"}}));
  run.advance(temporal::seconds(1000));
  EXPECT_EQ(run.state("rover.image.one"), (temporal::State{"stored", {}}));
  run.command(temporal::seconds(1000), execute("two", "camera", "image", {{"image", "two"}}));
  EXPECT_EQ(run.code("two"), "data-full");
  run.command(temporal::seconds(1001), execute("send", "radio", "send", {{"image", "i0"}}));
  run.advance(temporal::seconds(1500));
  run.command(temporal::seconds(1500), execute("three", "camera", "image", {{"image", "two"}}));
  run.advance(temporal::seconds(1600));
  EXPECT_EQ(run.state("rover.image.two"), (temporal::State{"stored", {}}));
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
