// A participant in another process, driven by lines on its standard input and answering on its standard
// output (see main.cpp). Three programs are built from it: our transports, and each vendor's own API and
// generated types.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace roci::contract_peer {

struct Goal {
  std::string issuer;
  std::string id;
  int priority = 0;
};

struct Call {
  std::array<std::uint8_t, 16> client{};  // writer GUID of the request id
  std::int64_t sequence = 0;
  double x_m = 0;
  double y_m = 0;
};

struct Answer {
  std::array<std::uint8_t, 16> client{};
  std::int64_t sequence = 0;
  int remote_exception = 0;
  std::string message;
  double length_m = 0;
  std::size_t waypoints = 0;
};

// Callbacks come from vendor threads.
struct Handlers {
  std::function<void(int)> matched;
  std::function<void(const Goal&)> goal;
  std::function<void(const char* how, const Goal& key)> goal_ended;  // how: "disposed" or "lost"
  std::function<void(const Call&)> call;
  std::function<void(const Answer&)> answer;
};

class Backend {
 public:
  virtual ~Backend() = default;
  virtual void open_goal_writer() = 0;
  virtual void open_goal_reader() = 0;
  virtual void open_path_server() = 0;
  virtual void open_path_client() = 0;
  virtual void open_stranger() = 0;  // writes goals on the topic of path requests
  virtual bool write(const Goal&) = 0;
  virtual bool dispose(const Goal&) = 0;
  virtual bool call(const Call&) = 0;
  virtual bool answer(const Answer&) = 0;
};

struct Settings {
  std::string vendor;  // our transport's name; the native programs know theirs
  int domain = 0;
  std::string address = "127.0.0.1";
  std::string peer = "127.0.0.1";
  std::string run{};           // that goals name
  std::string partition{};     // of all endpoints, if not empty
  std::string announcement{};  // USER_DATA of the participant
  std::string keys{};  // key folder of a secure participant, which is not checked first; empty: it is plain
  std::string service{};  // whose certificate it has from there
};

// Each program links one definition.
std::unique_ptr<Backend> make_backend(const Settings&, Handlers);

}  // namespace roci::contract_peer
