// roci-bench-dds [--rounds N] [--pings N] [--seed N] [--kinds LIST] [--vendors LIST] [--load N] [--secure=KEYS]
//                [--samples FILE]
// It measures round trips between two processes on loopback: each vendor's bare API against our transport
// over the same vendor, in one run and in turns, so that both see the same machine. It tells on standard error
// how far it is, and writes one JSON record to standard output. Every single time is appended to FILE, with what the
// server has waited for meanwhile (waits.hpp), so that a large number of them can be measured in slices, which merge.py
// puts together.
#include <sched.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <fstream>
#include <iostream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>

#include "bench/dds/port.hpp"
#include "bench/dds/waits.hpp"
#include "services/process/domain_claim.hpp"
#include "tests/contract/support/child_process.hpp"

namespace roci::bench {
namespace {

using Clock = std::chrono::steady_clock;
using services::contract::ChildProcess;

const std::vector<std::string> kVendors = {"fastdds", "cyclonedds"};
// The client on Fast DDS, the server on Cyclone DDS; it has no bare form.
constexpr char kMixed[] = "mixed";
// The kinds are bare (the vendor's API), ours (writer and reader of our transport), call (services/rpc.hpp on
// top of it), tuples (1,000 argument tuples in one request of ours), reaction (from an observation to the
// executive's command) and dedicated (the same through a dedicated executive). With --secure there are secure and
// secure_tuples, too: ours and tuples, encrypted.
const std::vector<std::string> kKinds = {"bare", "ours", "call", "tuples", "reaction", "dedicated"};
const std::vector<std::string> kSecureKinds = {"secure", "secure_tuples"};
std::vector<std::string> all_kinds() {
  auto kinds = kKinds;
  kinds.insert(kinds.end(), kSecureKinds.begin(), kSecureKinds.end());
  return kinds;
}

std::unique_ptr<Port> open(const std::string& variant, PortOptions options) {
  const auto dash = variant.find('-');
  const auto kind = variant.substr(0, dash);
  std::string vendor = variant.substr(dash + 1);
  if (vendor == kMixed) vendor = kVendors[options.side == Side::client ? 0 : 1];
  options.secure = kind.starts_with("secure");
  if (kind == "secure") return open_ours(vendor, std::move(options));
  if (kind == "secure_tuples") return open_ours_with_tuples(vendor, std::move(options));
  if (variant == "bare-fastdds") return open_fastdds(std::move(options));
  if (variant == "bare-cyclonedds") return open_cyclonedds(std::move(options));
  if (kind == "ours") return open_ours(vendor, std::move(options));
  if (kind == "call") return open_calls(vendor, std::move(options));
  if (kind == "reaction") return open_reaction(vendor, std::move(options));
  if (kind == "dedicated") return open_dedicated_reaction(vendor, std::move(options));
  if (kind == kDedicatedKind) return open_dedicated(vendor, options);
  if (kind == "tuples") return open_ours_with_tuples(vendor, std::move(options));
  throw std::invalid_argument("unknown variant " + variant);
}

// Hands over from the vendor's thread to the one that works, as in a service.
class Mailbox {
 public:
  void put(const Ball& ball) {
    const std::lock_guard lock(mutex_);
    balls_.push_back(ball);
    changed_.notify_one();
  }
  // Takes the next ball. Throws when nothing comes for 10 s.
  Ball take() {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, std::chrono::seconds(10), [this] { return !balls_.empty(); })) {
      throw std::runtime_error("a round trip got no answer within 10 s");
    }
    const Ball ball = balls_.front();
    balls_.pop_front();
    return ball;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Ball> balls_;
};

// A write is refused while a reader's acknowledgements are late; then it is simply tried again.
void send(Port& port, const Ball& ball) {
  const auto give_up = Clock::now() + std::chrono::seconds(10);
  while (!port.send(ball)) {
    if (Clock::now() > give_up) throw std::runtime_error("a sample could not be sent for 10 s");
  }
}

// Client and servers each stand on a processor of their own, all variants alike: where the scheduler happens
// to put a thread is worth more than what is measured here.
void pin_to(unsigned processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(processor % std::thread::hardware_concurrency(), &set);
  sched_setaffinity(0, sizeof set, &set);
}

// Returns each ball until its standard input ends.
int serve(const std::string& variant, int domain) {
  pin_to(1);
  publish_disk_waits();
  Mailbox mailbox;
  const auto port =
      open(variant, {Side::server, domain, [&mailbox](const Ball& ball) { mailbox.put(ball); }});
  std::jthread input([] {
    std::string line;
    while (std::getline(std::cin, line)) continue;
    _exit(0);
  });
  std::cout << "ready" << std::endl;
  for (;;) {
    try {
      send(*port, mailbox.take());
    } catch (const std::runtime_error&) {
      continue;  // nobody asks at the moment
    }
  }
}

class Rally {
 public:
  Rally(const std::string& program, const std::string& variant)
      : server_({program, "--serve", variant, "--domain", std::to_string(domain_.id())}),
        port_(open(variant, {Side::client, domain_.id(), [this](const Ball& ball) { mailbox_.put(ball); }})) {
    if (!server_.wait_for("ready")) throw std::runtime_error(variant + ": the server does not start");
    const auto give_up = Clock::now() + std::chrono::seconds(20);
    while (!port_->matched()) {
      if (Clock::now() > give_up)
        throw std::runtime_error(variant + ": client and server do not find each other");
      std::this_thread::yield();
    }
    warm_up();
  }

  ~Rally() { forget_disk_waits(server_.pid()); }

  void play(int pings, std::mt19937_64& random) {
    server_waited_.begin(server_.pid());
    client_waited_.begin(getpid());
    std::uniform_real_distribution<double> metres(-100, 100);
    for (int i = 0; i < pings; ++i) {
      const Ball ball{++sequence_, metres(random), metres(random)};
      const auto start = Clock::now();
      send(*port_, ball);
      while (mailbox_.take().sequence != ball.sequence) continue;
      microseconds_.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
      server_waited_.note();
      client_waited_.note();
    }
  }

  double slowest_us() const {
    return microseconds_.empty() ? 0 : *std::max_element(microseconds_.begin(), microseconds_.end());
  }

  const std::vector<double>& microseconds() const { return microseconds_; }
  /// What server and client have waited for in each of these.
  const std::vector<Waits>& server_waits() const { return server_waited_.each; }
  const std::vector<Waits>& client_waits() const { return client_waited_.each; }

  nlohmann::json result() {
    std::sort(microseconds_.begin(), microseconds_.end());
    const auto at = [this](double fraction) {
      return microseconds_[static_cast<std::size_t>(fraction *
                                                    static_cast<double>(microseconds_.size() - 1))];
    };
    return {{"median_us", at(0.5)},
            {"p99_us", at(0.99)},
            {"max_us", microseconds_.back()},
            {"round_trips", microseconds_.size()}};
  }

 private:
  // What one process has waited for in each round trip.
  struct Waited {
    pid_t process = 0;
    Waits before;
    std::vector<Waits> each;
    void begin(pid_t of) { before = waits_of(process = of); }
    void note() {
      const Waits now = waits_of(process);
      each.push_back(now - std::exchange(before, now));
    }
  };

  // The server's side of the match may come later than ours.
  void warm_up() {
    for (int i = 0; i < 100; ++i) {
      send(*port_, {++sequence_, 0, 0});
      std::this_thread::sleep_for(std::chrono::milliseconds(i < 20 ? 20 : 1));
    }
    while (mailbox_.take().sequence != sequence_) continue;
  }

  services::process::DomainClaim domain_;
  Mailbox mailbox_;
  ChildProcess server_;
  std::unique_ptr<Port> port_;
  std::int64_t sequence_ = 0;
  std::vector<double> microseconds_;
  Waited server_waited_, client_waited_;
};

nlohmann::json disk_us(const std::vector<Waits>& waits) {
  auto out = nlohmann::json::array();
  for (const Waits& one : waits) out.push_back(std::round(one.disk_us));
  return out;
}

nlohmann::json processor_us(const std::vector<Waits>& waits) {
  auto out = nlohmann::json::array();
  for (const Waits& one : waits) out.push_back(std::round(one.processor_us));
  return out;
}

std::string first_line_of(const std::vector<std::string>& command) {
  ChildProcess process(command);
  process.wait_for("\n", std::chrono::seconds(5));
  return process.lines().empty() ? "unknown" : process.lines().front();
}

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

struct BenchOptions {
  int rounds = 100;
  int pings = 50;
  std::uint64_t seed = 1;
  std::vector<std::string> vendors = kVendors;
  std::vector<std::string> kinds = kKinds;
  unsigned load = 0;
  std::string samples{};
};

// Threads that compute without end, so that the scheduler has something better to do than to wake who was asked.
class Load {
 public:
  explicit Load(unsigned threads) {
    for (unsigned i = 0; i < threads; ++i) {
      threads_.emplace_back([i](const std::stop_token& stop) {
        pin_to(i);
        volatile std::uint64_t counted = 0;
        while (!stop.stop_requested()) counted = counted + 1;
      });
    }
  }

 private:
  std::vector<std::jthread> threads_;
};

// One line that is written over on a terminal, a line now and then elsewhere.
void tell(const std::string& text, bool now_and_then = false) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!terminal && now_and_then) return;
  std::cerr << (terminal ? "\r\x1b[K" : "") << "roci-bench-dds: " << text << (terminal ? "" : "\n")
            << std::flush;
}

nlohmann::json measure(const std::string& program, const BenchOptions& options) {
  const auto& [rounds, pings, seed, vendors, kinds, load_threads, samples] = options;
  pin_to(0);
  std::map<std::string, Rally> rallies;
  for (const auto& vendor : vendors) {
    for (const auto& kind : kinds) {
      const auto variant = kind + "-" + vendor;
      if (variant == std::string("bare-") + kMixed) continue;
      tell("starting " + variant);
      rallies.emplace(std::piecewise_construct, std::forward_as_tuple(variant),
                      std::forward_as_tuple(program, variant));
    }
  }
  const Load load(load_threads);
  std::mt19937_64 random(seed);
  std::string slowest;  // so far
  for (int round = 0; round < rounds; ++round) {
    tell("round " + std::to_string(round + 1) + " of " + std::to_string(rounds) + slowest,
         round % std::max(rounds / 10, 1) != 0);
    slowest.clear();
    for (auto& [variant, rally] : rallies) {
      rally.play(pings, random);
      slowest += ", " + variant + " up to " + std::to_string(static_cast<long>(rally.slowest_us())) + " us";
    }
  }
  if (isatty(STDERR_FILENO) != 0) std::cerr << "\n";
  nlohmann::json record{
      {"bench", "dds"},
      {"host", host_name()},
      {"processors", std::thread::hardware_concurrency()},
      {"revision", first_line_of({"git", "-C", ROCI_SOURCE_DIR, "describe", "--always", "--dirty"})},
      {"load_threads", load_threads},
      {"seed", seed}};
  if (!samples.empty()) {
    std::ofstream out(samples, std::ios::app);
    for (auto& [variant, rally] : rallies)
      out << nlohmann::json{{"variant", variant},
                            {"seed", seed},
                            {"load_threads", load_threads},
                            {"revision", record["revision"]},
                            {"microseconds", rally.microseconds()},
                            {"disk_us", disk_us(rally.server_waits())},
                            {"server_processor_us", processor_us(rally.server_waits())},
                            {"client_processor_us", processor_us(rally.client_waits())}}
          << "\n";
  }
  for (auto& [variant, rally] : rallies) record["results"][variant] = rally.result();
  for (const auto& vendor : vendors) {
    if (!rallies.contains("bare-" + vendor)) continue;
    const double bare = record["results"]["bare-" + vendor]["median_us"];
    for (const std::string kind : {"ours", "secure", "call", "reaction", "dedicated"}) {
      if (!rallies.contains(kind + "-" + vendor)) continue;
      const double median = record["results"][kind + "-" + vendor]["median_us"];
      record["ratio_to_bare"][kind + "-" + vendor] = median / bare;
    }
  }
  for (const auto& vendor : vendors) {
    if (!rallies.contains("reaction-" + vendor) || !rallies.contains("dedicated-" + vendor)) continue;
    const auto& direct = record["results"]["reaction-" + vendor];
    const auto& dedicated = record["results"]["dedicated-" + vendor];
    for (const std::string figure : {"median_us", "p99_us"})
      record["ratio_dedicated_to_direct"][vendor][figure] =
          dedicated[figure].get<double>() / direct[figure].get<double>();
  }
  return record;
}

}  // namespace
}  // namespace roci::bench

int main(int argc, char** argv) {
  CLI::App app("Round trips over DDS: each vendor's bare API against our transport");
  roci::bench::BenchOptions options;
  int domain = 0;
  std::string serve;
  app.add_option("--rounds", options.rounds, "turns of each variant")->check(CLI::PositiveNumber);
  app.add_option("--pings", options.pings, "round trips per turn")->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "of the numbers in the samples");
  app.add_option("--kinds", options.kinds,
                 "these alone: bare, ours, call, tuples, reaction, dedicated, secure, secure_tuples")
      ->delimiter(',')
      ->check(CLI::IsMember(roci::bench::all_kinds()));
  app.add_option("--vendors", options.vendors,
                 "these alone; mixed: the client on Fast DDS, the server on Cyclone DDS")
      ->delimiter(',')
      ->check(CLI::IsMember({"fastdds", "cyclonedds", roci::bench::kMixed}));
  app.add_option("--load", options.load, "threads that compute meanwhile");
  std::string keys;
  app.add_option("--secure", keys,
                 "measure secure runs, too, with the keys of this folder (roci-keys make missions/planetary "
                 "--keys KEYS)");
  app.add_option("--samples", options.samples, "every single time is appended to this file (merge.py)");
  app.add_option("--serve", serve)->group("");
  app.add_option("--domain", domain)->group("");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!keys.empty()) {
      setenv(roci::bench::kKeysVariable, keys.c_str(), 1);
      if (app.count("--kinds") == 0) options.kinds = roci::bench::all_kinds();
    }
    if (!serve.empty()) return roci::bench::serve(serve, domain);
    std::cout << roci::bench::measure(argv[0], options).dump() << std::endl;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "roci-bench-dds: " << error.what() << std::endl;
    return 1;
  }
}
