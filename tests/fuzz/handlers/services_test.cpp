// Every handler of every service, in one process: samples that decode, with any value in any member, and damaged ones,
// on all topics at once. No service ends, hangs or lets an exception out, and each goes on.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "ground_console/cli/report.hpp"
#include "ground_console/lib/client.hpp"
#include "rehearsal/flight.hpp"
#include "services/clock/wall.hpp"
#include "services/launch/progress.hpp"
#include "services/time_watch.hpp"
#include "services/transport/plug_ins.hpp"
#include "services/transport/scope.hpp"
#include "tests/fuzz/rounds.hpp"
#include "tests/fuzz/topics/decoders.hpp"
#include "tests/fuzz/topics/sample_maker.hpp"

namespace roci::fuzz {
namespace {

namespace fs = std::filesystem;
namespace transport = services::transport;
using services::node::NodeOptions;

const fs::path kPlanetary = ROCI_SOURCE_DIR "/missions/planetary";
const fs::path kLander = ROCI_SOURCE_DIR "/tests/missions/lander";  // its engine plans all the time
constexpr int kDomain = 77;
constexpr int kBatch = 200;  // samples between two turns of the services

std::unique_ptr<transport::Transport> open_inproc(const std::string& participant) {
  transport::TransportOptions options;
  options.domain = kDomain;
  options.participant = participant;
  return transport::open_transport("inproc", options);
}

struct Seat {
  std::unique_ptr<services::Node> node;
  std::unique_ptr<services::TimeWatch> time;
  std::unique_ptr<services::Service> service;
};

// A mission's services on the live clock, a launcher's line and a console.
class Crew {
 public:
  explicit Crew(const fs::path& mission)
      : folder_(fs::temp_directory_path() / ("roci-fuzz-handlers-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    services::RunSettings run;
    run.mission = mission;
    run.run_folder = folder_;
    for (const mission::ServiceEntry& entry : rehearsal::crew_of(mission)) {
      NodeOptions options = rehearsal::node_options(mission, entry, 0);
      options.clock = services::clock::ClockMode::live;
      options.epoch_unix_us = services::clock::unix_us();
      Seat seat;
      seat.node = std::make_unique<services::Node>(options, open_inproc(entry.name));
      seat.time = std::make_unique<services::TimeWatch>(*seat.node,
                                                        services::TimeWatchSettings{.reference = "sim_svc"});
      seat.service = rehearsal::make_of(entry)(*seat.node, run);
      seats_.push_back(std::move(seat));
    }
    NodeOptions launcher;
    launcher.name = "launcher";
    launcher.run = mission.filename();
    launcher.incarnation = 0;
    launcher.clock = services::clock::ClockMode::observer;
    launcher_ = std::make_unique<services::Node>(launcher, open_inproc("launcher"));
    progress_ = std::make_unique<services::launch::Progress>(*launcher_, false);
    services::process::Connection connection;
    connection.dds = "inproc";
    connection.run = mission.filename();
    connection.transport.domain = kDomain;
    console_ = std::make_unique<console::lib::Client>(connection);
  }
  ~Crew() {
    progress_.reset();
    for (Seat& seat : seats_) seat.service.reset();
    seats_.clear();
    fs::remove_all(folder_);
  }

  void turn() {
    for (Seat& seat : seats_) seat.node->spin_once(std::chrono::milliseconds(0));
    launcher_->spin_once(std::chrono::milliseconds(0));
    progress_->show();
    console_->wait([] { return false; }, std::chrono::milliseconds(1));
  }

  const console::lib::MissionView& view() const { return console_->view(); }
  const std::vector<Seat>& seats() const { return seats_; }

 private:
  fs::path folder_;
  std::vector<Seat> seats_;
  std::unique_ptr<services::Node> launcher_;
  std::unique_ptr<services::launch::Progress> progress_;
  std::unique_ptr<console::lib::Client> console_;
};

// Writes bytes on every topic, as somebody who speaks our contract may.
class Intruder {
 public:
  Intruder() : transport_(open_inproc("intruder")) {
    for (const Decoder& decoder : decoders()) {
      const services::node::TopicSpec& topic = decoder.topic;
      const transport::EndpointDescription endpoint{
          topic.name, topic.codec.type,
          transport::writer_qos(topic.qos, topic.clocking, services::clock::ClockMode::observer),
          transport::partitions_of(topic.scope, "")};
      writers_.push_back(transport_->create_writer(endpoint, {}));
    }
  }
  void write(std::size_t topic, const transport::Payload& payload) { writers_[topic]->write(payload); }
  std::size_t topics() const { return writers_.size(); }

 private:
  std::unique_ptr<transport::Transport> transport_;
  std::vector<std::unique_ptr<transport::Writer>> writers_;
};

void expect_to_go_on(const fs::path& mission, SampleMaker maker) {
  Crew crew(mission);
  Intruder intruder;
  for (int i = 0; i < 20; ++i) crew.turn();
  for (int sent = 0; sent < rounds(6000); ++sent) {
    const std::size_t topic = maker.below(intruder.topics());
    MadeSample sample = maker.make(decoders()[topic].type, 4);
    intruder.write(topic, maker.below(4) == 0 ? maker.damaged(sample) : sample.payload);
    if (sent % kBatch != 0) continue;
    ASSERT_NO_THROW(crew.turn()) << "after " << sent << " samples";
    ASSERT_NO_THROW(console::cli::status_text(crew.view()));
    ASSERT_NO_THROW(console::cli::json_text(console::cli::status_json(crew.view())));
    ASSERT_NO_THROW(console::cli::json_text(console::cli::plan_json(crew.view())));
    for (const v1::Event& event : crew.view().events()) {
      for (const char c : console::cli::event_line(event)) ASSERT_FALSE(c == '\x1b') << event.text();
      EXPECT_NE(event.code(), "planner.defect") << event.text();
    }
  }
  for (int i = 0; i < 20; ++i) ASSERT_NO_THROW(crew.turn());
  std::set<std::string> heard;
  for (const auto& [name, beat] : crew.view().services()) heard.insert(name);
  for (const Seat& seat : crew.seats())
    EXPECT_TRUE(heard.contains(seat.node->options().name)) << seat.node->options().name << " is silent";
}

TEST(FuzzHandlers, NoServiceFallsOverWhatDecodes) { expect_to_go_on(kPlanetary, SampleMaker(7)); }

// Networks, downlink schedules and outlooks come to services that use them.
TEST(FuzzHandlers, NoServiceOfALanderFallsOverWhatDecodes) {
  const std::vector<std::string> words{"lander",
                                       "lander.battery",
                                       "lander.lamp",
                                       "lit",
                                       "dark",
                                       "small-lander",
                                       "utility_htn",
                                       "mission",
                                       "request",
                                       "task",
                                       "sample_near",
                                       "dig_near#1.0",
                                       "network#1",
                                       "dig_s_far",
                                       "picture",
                                       "eye",
                                       "radio",
                                       "done.view",
                                       "image_near",
                                       "farewell",
                                       "n2",
                                       "parameter.dig_w",
                                       "sample_near/image_near/picture"};
  expect_to_go_on(kLander, SampleMaker(11, "lander", words));
}

}  // namespace
}  // namespace roci::fuzz
