// contract-hostile ROLE DOMAIN …: attacks the participants of a domain with bytes of its own, through no vendor, until
// its input ends.
//   writers            on loopback, a writer on every topic, all of whose samples are malformed, again and again
//   goals ADDRESS ID   a writer on roci/goal that writes the goal stranger/ID well-formed to the host with that address
//   gaps               on loopback, two writers on roci/goal, whose GAPs skip 2^18 numbers each, always further ones
//   ahead              on loopback, a writer on roci/goal that never says its first sample, but always further ones
//   asks PREFIX 0      on loopback, a reader on roci/goal that asks the participant with that GUID prefix (24 hexadecimal
//                      digits) for samples and fragments that are not, and acknowledges what was never sent
//   inject SEED COUNT  on loopback, mutants of the traffic that it hears and forged datagrams, COUNT at least
// Standard output, one line each: ready | round N (all was sent N times) | sent COUNT SEED.
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <utility>

#include "services/transport/announcement.hpp"
#include "services/transport/type_support.hpp"
#include "tests/contract/hostile/every_topic.hpp"
#include "tests/contract/hostile/injector.hpp"
#include "tests/contract/hostile/samples.hpp"

namespace roci::services::contract::hostile {
namespace {

constexpr std::uint32_t kLoopback = 0x7f000001;

std::uint32_t address_of(const std::string& text) {
  std::uint32_t address = 0, part = 0;
  for (const char c : text + ".") {
    if (c == '.')
      address = address << 8 | std::exchange(part, 0);
    else
      part = part * 10 + static_cast<std::uint32_t>(c - '0');
  }
  return address;
}

// False once the input has ended.
bool wait_a_moment() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return poll(&input, 1, 100) == 0;
}

void say(const std::string& line) { std::cout << line << std::endl; }

// Whom a run cannot tell from its own: same announcement, all partitions of the topic.
class Attackers {
 public:
  Attackers(std::uint32_t target, int domain)
      : fast_(target, domain, kEprosima, 1, transport::own_announcement()),
        cyclone_(target, domain, kEclipse, 2, transport::own_announcement()) {
    const Bytes another = transport::serialize(v1::JournalChunk());
    for_each_topic([&]<class T>(const topics::Topic<T>& topic) {
      const EndpointDescription writer{topic.name, topic.type_name, T::isKeyDefined(),
                                     transport::partitions_of(topic.scope, "")};
      T good;
      good = {};
      for (Participant* participant : {&fast_, &cyclone_})
        writers_.emplace_back(*participant, participant->add_writer(writer), transport::serialize(good),
                              another);
    });
  }

  void run() {
    for (int round = 0; wait_a_moment(); ++round) {
      fast_.announce();
      cyclone_.announce();
      if (round == 1)
        for (HostileWriter& writer : writers_) writer.attack();
      if (round > 1)
        for (const HostileWriter& writer : writers_) writer.repeat();
      say("round " + std::to_string(round));
    }
  }

 private:
  Participant fast_, cyclone_;
  std::vector<HostileWriter> writers_;
};

void write_goals(std::uint32_t target, int domain, const std::string& id) {
  Participant participant(target, domain, kEclipse, 3, transport::own_announcement());
  const Entity writer = participant.add_writer({topics::goal.name, topics::goal.type_name, true, {}});
  v1::Goal goal;
  goal.issuer("stranger");
  goal.id(id);
  goal.priority(1);
  const Bytes payload = transport::serialize(goal);
  for (int round = 0; wait_a_moment(); ++round) {
    participant.announce();
    auto message = participant.message();
    message.heartbeat(0, writer, 1, 1, static_cast<std::uint32_t>(round + 1))
        .data(0, writer, 1, kData, {}, payload);
    participant.send_to_readers(message);
    say("round " + std::to_string(round));
  }
}

// A reader of Fast DDS keeps each of these numbers, since it still waits for the first one.
void skip_numbers(int domain) {
  constexpr std::int64_t kAtOnce = std::int64_t{1} << 18;
  constexpr int kGapsOfRound = 5;
  Participant first(kLoopback, domain, kEprosima, 1, transport::own_announcement());
  Participant second(kLoopback, domain, kEclipse, 2, transport::own_announcement());
  for (Participant* participant : {&first, &second})
    participant->add_writer(
        {topics::goal.name, topics::goal.type_name, true, transport::partitions_of(topics::goal.scope, "")});
  std::int64_t next = 2;
  for (int round = 0; wait_a_moment(); ++round) {
    for (Participant* participant : {&first, &second}) {
      participant->announce();
      for (int i = 0; i < kGapsOfRound; ++i)
        participant->send_to_readers(participant->message().gap(0, writer_id(0, true), next + i * kAtOnce,
                                                                next + (i + 1) * kAtOnce, 0));
    }
    next += kGapsOfRound * kAtOnce;
    say("round " + std::to_string(round));
  }
}

// A reader of Fast DDS keeps each of these samples, since it still waits for the first one.
void run_ahead(int domain) {
  constexpr int kSamplesOfRound = 60;
  Participant one(kLoopback, domain, kEprosima, 1, transport::own_announcement());
  const Entity writer = one.add_writer(
      {topics::goal.name, topics::goal.type_name, true, transport::partitions_of(topics::goal.scope, "")});
  std::int64_t next = 2;
  for (int round = 0; wait_a_moment(); ++round) {
    one.announce();
    for (int i = 0; i < kSamplesOfRound && round > 5; ++i) {
      v1::Goal goal;
      goal.issuer("stranger");
      goal.id(std::to_string(next) + std::string(60'000, 'x'));
      one.send_to_readers(one.message().data(0, writer, next++, kData, {}, transport::serialize(goal)));
    }
    say("round " + std::to_string(round));
  }
}

// A reader of Fast DDS aborts on a last number without measure, and walks to a first one.
void begin_late(int domain) {
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max(), kFar = std::int64_t{1} << 40;
  Participant one(kLoopback, domain, kEprosima, 1, transport::own_announcement());
  Participant two(kLoopback, domain, kEclipse, 2, transport::own_announcement());
  for (Participant* participant : {&one, &two})
    participant->add_writer(
        {topics::goal.name, topics::goal.type_name, true, transport::partitions_of(topics::goal.scope, "")});
  std::uint32_t count = 0;
  for (int round = 0; wait_a_moment(); ++round) {
    for (Participant* participant : {&one, &two}) {
      participant->announce();
      if (round < 5) continue;  // matched by then
      for (const auto& [first, last] : {std::pair{std::int64_t{1}, kLast}, {kLast, kLast}, {kFar, kFar}})
        participant->send_to_readers(
            participant->message().heartbeat(0, writer_id(0, true), first, last, ++count));
    }
    say("round " + std::to_string(round));
  }
}

Prefix prefix_of(const std::string& digits) {
  Prefix prefix;
  for (std::size_t i = 0; i < prefix.size(); ++i)
    prefix[i] = static_cast<std::uint8_t>(std::stoi(digits.substr(2 * i, 2), nullptr, 16));
  return prefix;
}

// Its writer is one of the first that the participant made.
void ask_without_measure(int domain, const Prefix& whom) {
  constexpr std::uint32_t kWriters = 16;
  Participant one(kLoopback, domain, kEprosima, 1, transport::own_announcement());
  const Entity reader = one.add_reader(
      {topics::goal.name, topics::goal.type_name, true, transport::partitions_of(topics::goal.scope, "")});
  std::uint32_t count = 0;
  const auto to_each = [&](const auto& say_to) {
    for (std::uint32_t i = 1; i <= kWriters; ++i) {
      auto message = one.message();
      message.submessage(0x0e, 0, Bytes(whom.begin(), whom.end()));
      say_to(message, i << 8 | 0x02, ++count);
      one.send_to_readers(message);
    }
  };
  constexpr std::int64_t kFar = std::int64_t{1} << 47;
  for (int round = 0; wait_a_moment(); ++round) {
    one.announce();
    if (round > 5) {  // matched by then
      for (const std::int64_t number : {1, 2, 3, 1000})
        for (const std::uint32_t base : {1U, 2U, 3U, 4U, 100U, 0x7fffffffU, 0xffffff00U, 0xffffffffU})
          for (const std::uint32_t bits : {0U, 1U, 32U, 256U})
            to_each([&](Message& message, Entity writer, std::uint32_t n) {
              message.nack_fragments(reader, writer, number, base, bits, 0xff, n);
            });
      for (const std::int64_t base : {std::int64_t{1}, std::int64_t{2}, std::int64_t{3}, std::int64_t{4}, kFar,
                                      std::int64_t{0}, 2 * kFar, std::int64_t{1}})
        for (const std::uint32_t bits : {0U, 1U, 32U, 256U})
          to_each([&](Message& message, Entity writer, std::uint32_t n) {
            message.acknack(reader, writer, base, bits, 0xff, n);
          });
    }
    say("round " + std::to_string(round));
  }
}

void run(const std::vector<std::string>& words) {
  if (words.size() < 2)
    throw std::invalid_argument("usage: contract-hostile ROLE DOMAIN [ADDRESS ID | SEED COUNT]");
  const int domain = std::stoi(words[1]);
  say("ready");
  if (words[0] == "writers") return Attackers(kLoopback, domain).run();
  if (words[0] == "gaps") return skip_numbers(domain);
  if (words[0] == "ahead") return run_ahead(domain);
  if (words[0] == "starts") return begin_late(domain);
  if (words.size() != 4) throw std::invalid_argument("unknown role " + words[0]);
  if (words[0] == "asks") return ask_without_measure(domain, prefix_of(words[2]));
  if (words[0] == "goals") return write_goals(address_of(words[2]), domain, words[3]);
  if (words[0] != "inject") throw std::invalid_argument("unknown role " + words[0]);
  Injector injector(domain, std::stoull(words[2]));
  injector.send(std::stoull(words[3]), [sent = false, &words](bool enough) mutable {
    if (enough && !std::exchange(sent, true)) say("sent " + words[3] + " " + words[2]);
    pollfd input{STDIN_FILENO, POLLIN, 0};
    return poll(&input, 1, 0) == 0;
  });
}

}  // namespace
}  // namespace roci::services::contract::hostile

int main(int argc, char** argv) {
  try {
    roci::services::contract::hostile::run({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
