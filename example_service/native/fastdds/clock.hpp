// A service under the clock of a run, live or simulated, as docs/protocol-clock.md has it.
#pragma once

#include <csignal>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "clock.h"
#include "participant.hpp"

namespace borehole {

class Clock {
 public:
  explicit Clock(Participant&);

  std::int64_t now_us() const;  // mission time

  // To be called before run(). A clocked topic is handled in the order of the clock.
  template <class Type, class T>
  void read(const std::string& topic, Durability durability, std::function<void(const T&)> handle) {
    dds::DataReader* reader = participant_.input<Type>(topic, durability, true);
    topics_.push_back(topic);
    takers_.push_back([this, reader, topic, handle] {
      dds::SampleInfo info;
      for (T sample; reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK;)
        if (info.valid_data) arrive({topic, sample.header(), [handle, sample] { handle(sample); }});
    });
  }
  template <class Type>
  Output& advertise(const std::string& topic, Durability durability) {
    return outputs_[topic] = participant_.output<Type>(topic, durability, true);
  }
  template <class T>
  void write(Output& output, T sample) {
    participant_.write(output, std::move(sample), now_us());
  }

  // The service's own time: its earliest timer, and what fires those that are due.
  std::function<std::optional<std::int64_t>()> next_us;
  std::function<void()> wake;

  // Runs until the clock ends, or `stop` is set. Returns the exit code (docs/exit-codes.md, "Services").
  int run(const volatile std::sig_atomic_t& stop);

 private:
  using StreamKey = std::tuple<std::string, std::string, std::uint32_t>;  // topic, sender, incarnation

  void arrive(Arrival);
  void beat(bool stopping);
  void say_ready();
  void take_steps();
  bool listed(const std::string& service, std::uint32_t incarnation) const;
  bool asks_me() const;
  bool hears(const v1::StreamCount&) const;
  bool complete() const;
  void deliver();
  void answer();
  void follow();

  Participant& participant_;
  const Options& options_;
  std::vector<std::string> topics_;
  std::vector<std::function<void()>> takers_;
  std::map<std::string, Output> outputs_;
  Output ready_, done_, heartbeat_;
  dds::DataReader* steps_ = nullptr;
  std::optional<v1::ClockStep> step_;  // the newest of this run
  std::optional<v1::ClockDone> answered_;
  std::map<StreamKey, std::map<std::uint64_t, Arrival>> held_;  // by number
  std::map<StreamKey, std::uint64_t> delivered_;
  std::vector<Arrival> outside_;  // of observers
  bool admitted_ = false, joined_ = false, asked_ = false, master_gone_ = false;
  std::int64_t simulated_us_ = 0;
  std::uint64_t progress_ = 0;
  std::chrono::steady_clock::time_point next_beat_, next_ready_;
};

}  // namespace borehole
