// peer ROLE VENDOR DOMAIN [ADDRESS PEER]; environment: PEER_RUN, PEER_PARTITION,
// PEER_ANNOUNCEMENT (own: as this build's),
//   PEER_KEYS and PEER_SERVICE (a secure participant with the certificate of that service)
//   PEER_WAYPOINTS (of the ways that a path-server answers; 2)
//   PEER_UNANSWERED (calls from this number on are heard and not answered)
//   ROLE: goal-writer, goal-reader, path-server, path-client, stranger (a goal-writer on the topic of path requests)
// Standard input: write ISSUER ID PRIORITY | dispose ISSUER ID | call SEQUENCE X Y; it ends with the input.
// Standard output, one line each: ready | matched N | goal ISSUER ID PRIORITY | disposed ISSUER ID | lost
// ISSUER ID |
//   call SEQUENCE X Y | answer SEQUENCE EXCEPTION MESSAGE LENGTH WAYPOINTS SAME_CLIENT | refused
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "roci_idl/contract.h"
#include "tests/contract/peer/backend.hpp"

namespace roci::contract_peer {
namespace {

// Work for the main thread: no vendor thread ever writes.
class Loop {
 public:
  void post(std::function<void()> job) {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
    changed_.notify_one();
  }
  void stop() { post(nullptr); }
  void run() {
    for (;;) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !jobs_.empty(); });
      const auto job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      if (!job) return;
      job();
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
};

constexpr std::array<std::uint8_t, 16> kClient{0xC1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 0xFF};

std::string variable(const char* name, const std::string& fallback) {
  const char* value = std::getenv(name);
  return value == nullptr ? fallback : value;
}

void say(const std::string& line) { std::cout << line << std::endl; }

Handlers handlers(Loop& loop, std::unique_ptr<Backend>& backend) {
  const auto later = [&loop](auto function) {
    return [&loop, function](auto... values) { loop.post([=] { function(values...); }); };
  };
  return {
      .matched = later([](int count) { say("matched " + std::to_string(count)); }),
      .goal = later([](const Goal& goal) {
        say("goal " + goal.issuer + " " + goal.id + " " + std::to_string(goal.priority));
      }),
      .goal_ended = later(
          [](const char* how, const Goal& key) { say(std::string(how) + " " + key.issuer + " " + key.id); }),
      .call = later([&backend](const Call& call) {
        std::ostringstream line;
        line << "call " << call.sequence << " " << call.x_m << " " << call.y_m;
        say(line.str());
        const std::string unanswered = variable("PEER_UNANSWERED", "");
        if (!unanswered.empty() && call.sequence >= std::stoll(unanswered)) return;
        if (!backend->answer({call.client, call.sequence, 0, "found", std::hypot(call.x_m, call.y_m),
                              std::stoul(variable("PEER_WAYPOINTS", "2"))})) {
          say("refused");
        }
      }),
      .answer = later([](const Answer& answer) {
        std::ostringstream line;
        line << "answer " << answer.sequence << " " << answer.remote_exception << " " << answer.message << " "
             << answer.length_m << " " << answer.waypoints << " "
             << (answer.client == kClient ? "yes" : "no");
        say(line.str());
      }),
  };
}

void obey(Backend& backend, const std::string& line) {
  std::istringstream words(line);
  std::string verb;
  Goal goal;
  Call call{.client = kClient};
  words >> verb;
  bool done = false;
  if (verb == "write" && words >> goal.issuer >> goal.id >> goal.priority) done = backend.write(goal);
  if (verb == "dispose" && words >> goal.issuer >> goal.id) done = backend.dispose(goal);
  if (verb == "call" && words >> call.sequence >> call.x_m >> call.y_m) done = backend.call(call);
  if (!done) say("refused");
}

void open_role(Backend& backend, const std::string& role) {
  if (role == "goal-writer") return backend.open_goal_writer();
  if (role == "goal-reader") return backend.open_goal_reader();
  if (role == "path-server") return backend.open_path_server();
  if (role == "path-client") return backend.open_path_client();
  if (role == "stranger") return backend.open_stranger();
  throw std::invalid_argument("unknown role " + role);
}

int run(int argc, char** argv) {
  if (argc != 4 && argc != 6) throw std::invalid_argument("usage: peer ROLE VENDOR DOMAIN [ADDRESS PEER]");
  Settings settings{.vendor = argv[2], .domain = std::stoi(argv[3])};
  if (argc == 6) settings.address = argv[4], settings.peer = argv[5];
  settings.run = variable("PEER_RUN", "");
  settings.partition = variable("PEER_PARTITION", "");
  settings.keys = variable("PEER_KEYS", "");
  settings.service = variable("PEER_SERVICE", "");
  settings.announcement = variable("PEER_ANNOUNCEMENT", "own");
  if (settings.announcement == "own") settings.announcement = ROCI_ANNOUNCEMENT;

  Loop loop;
  std::unique_ptr<Backend> backend;
  backend = make_backend(settings, handlers(loop, backend));
  open_role(*backend, argv[1]);
  say("ready");
  std::jthread input([&loop, &backend] {
    std::string line;
    while (std::getline(std::cin, line)) loop.post([&backend, line] { obey(*backend, line); });
    loop.stop();
  });
  loop.run();
  backend.reset();
  return 0;
}

}  // namespace
}  // namespace roci::contract_peer

int main(int argc, char** argv) {
  try {
    return roci::contract_peer::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
