// The state machines of the simulated clock, fed with any values that decode.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "services/bounds/limits.hpp"
#include "services/clock/clock_master.hpp"
#include "services/clock/hold_back_queue.hpp"
#include "services/node/roster_view.hpp"
#include "tests/fuzz/rounds.hpp"
#include "tests/fuzz/topics/decoders.hpp"
#include "tests/fuzz/topics/sample_maker.hpp"

namespace roci::fuzz {
namespace {

using services::clock::ClockMaster;
using services::clock::HoldBackQueue;

template <class T>
T random_value(SampleMaker& maker, const std::string& type) {
  for (const Decoder& decoder : decoders()) {
    if (decoder.type != type) continue;
    const auto decoded = decoder.topic.codec.decode(maker.make(type, 6).payload);
    return *static_cast<const T*>(decoded.value.get());
  }
  throw std::out_of_range(type);
}

TEST(FuzzClock, TheMasterTakesWhateverParticipantsSay) {
  SampleMaker maker(1);
  ClockMaster master("sim_svc", {"sim_svc", "exec_svc"});
  for (int i = 0; i < rounds(3000); ++i) {
    master.ready(random_value<v1::ClockReady>(maker, "ClockReady"));
    master.done(random_value<v1::ClockDone>(maker, "ClockDone"));
    if (const auto window = master.window()) {
      try {
        master.issue(window->earliest);
      } catch (const services::clock::ClockError&) {
        master = ClockMaster("sim_svc", {"sim_svc", "exec_svc"});
      }
    }
    master.take_revision();
  }
}

TEST(FuzzClock, AParticipantTakesWhateverTheMasterSays) {
  SampleMaker maker(2);
  HoldBackQueue queue;
  services::node::RosterView roster;
  queue.subscribe("rover", services::clock::Durability::transient_local,
                  [](const void*) { return HoldBackQueue::Key{1}; });
  queue.subscribe("x", services::clock::Durability::volatile_,
                  [](const void*) { return HoldBackQueue::Key{2}; });
  for (int i = 0; i < rounds(3000); ++i) {
    const auto goal = random_value<v1::Goal>(maker, "Goal");
    queue.add(maker.below(2) == 0 ? "rover" : "x", goal.header(), std::make_shared<int>(1));
    queue.add("x", goal.header(), nullptr);
    const auto step = random_value<v1::ClockStep>(maker, "ClockStep");
    roster.update(step, "exec_svc");
    queue.missing(step);
    if (queue.complete(step)) queue.take(step);
  }
}

}  // namespace
}  // namespace roci::fuzz
