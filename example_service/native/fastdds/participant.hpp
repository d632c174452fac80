// The participant of a service and its endpoints: settings, QoS and partitions of docs/dds.md.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "basic.h"

namespace borehole {

namespace dds = eprosima::fastdds::dds;
namespace v1 = roci::v1;

// What the launcher says on the command line (docs/protocol-clock.md, "The command line").
struct Options {
  std::string name = "drill_svc", run, mission, robot;
  std::uint32_t domain = 0, incarnation = 1;
  bool simulated = false;
  double scale = 1, epoch_s = 0;  // live: mission seconds per second; mission time 0 in seconds since 1970
};

enum class Durability { state, request };  // the two QoS of the table that a drill uses

// A clocked sample as the clock sees it, and what is to be done with it.
struct Arrival {
  std::string topic;
  v1::SampleHeader header;
  std::function<void()> handle;
};

// fastddsgen's getKey() hashes the padding between the members of a key as the key before has left it, so that one key
// has several hashes, and each counts as an instance of its own.
template <class Type>
class CleanKey : public Type {
 public:
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool force_md5) override {
    std::memset(this->m_keyBuffer, 0, std::max<std::size_t>(16, Type::type::getKeyMaxCdrSerializedSize()));
    return Type::getKey(data, handle, force_md5);
  }
};

// What vendor threads leave for the service's loop.
class Inbox : public dds::DataReaderListener {
 public:
  void wait(std::chrono::milliseconds);
  void on_data_available(dds::DataReader*) override;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool something_ = false;
};

// A topic that we write. Clocked samples are numbered.
struct Output {
  std::string topic;
  dds::DataWriter* writer = nullptr;
  std::uint64_t total = 0, reported = 0;
};

class Participant {
 public:
  explicit Participant(const Options&);
  ~Participant();

  // Wall topics belong to everyone and have no partition; clocked ones are inner topics of the robot.
  template <class Type>
  Output output(const std::string& topic, Durability durability, bool clocked) {
    return {topic, open_writer(dds::TypeSupport(new CleanKey<Type>), topic, durability, clocked)};
  }
  template <class Type>
  dds::DataReader* input(const std::string& topic, Durability durability, bool clocked) {
    return open_reader(dds::TypeSupport(new CleanKey<Type>), topic, durability, clocked);
  }

  // Numbers and writes a clocked sample.
  template <class T>
  void write(Output& output, T sample, std::int64_t now_us) const {
    v1::SampleHeader& header = sample.header();
    header.run(options_.run);
    header.robot(options_.robot);
    header.sender(options_.name);
    header.incarnation(options_.incarnation);
    header.seq(output.total + 1);
    header.stamp_us(now_us);
    if (!output.writer->write(&sample))
      throw std::runtime_error("a sample could not be written on " + output.topic);
    ++output.total;
  }

  const Options& options() const { return options_; }
  Inbox& inbox() { return inbox_; }

 private:
  dds::DataWriter* open_writer(const dds::TypeSupport&, const std::string&, Durability, bool clocked);
  dds::DataReader* open_reader(const dds::TypeSupport&, const std::string&, Durability, bool clocked);
  dds::Topic* open_topic(const dds::TypeSupport&, const std::string&);

  Options options_;
  Inbox inbox_;
  dds::DomainParticipant* participant_ = nullptr;
  dds::Publisher* publishers_[2] = {};  // without and with the partition of the robot
  dds::Subscriber* subscribers_[2] = {};
};

}  // namespace borehole
