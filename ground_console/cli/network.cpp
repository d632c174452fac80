#include "ground_console/cli/network.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/bytes/crc_32.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/verbs.hpp"

namespace roci::console::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::array kNetworkStages{"received", "refused", "accepted", "in force"};

const char* stage_name(v1::NetworkStage stage) { return kNetworkStages.at(static_cast<std::size_t>(stage)); }

// The folder goes with its contents.
class OwnFolder {
 public:
  OwnFolder() {
    std::string name = (fs::temp_directory_path() / "roci-network-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder in " + name);
    path_ = name;
  }
  ~OwnFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Standard output is not its own: what it tells goes to standard error.
int run_program(const fs::path& program, std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  pid_t child = 0;
  const int failed = posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0)
    throw std::invalid_argument("cannot start " + program.string() + "; install it beside roci");
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

json to_json(const v1::NetworkStatus& status) {
  return {{"planner", status.planner()},
          {"issuer", status.issuer()},
          {"id", status.id()},
          {"stage", stage_name(status.stage())},
          {"network", status.network()},
          {"network_version", status.network_version()},
          {"plan_version", status.plan_version()},
          {"reasons", status.reasons()}};
}

}  // namespace

std::string packed_network(const std::string& file) {
  const OwnFolder folder;
  const std::string packed = folder.path() / "network.htn";
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "roci-network";
  if (run_program(program, {"roci-network", "pack", file, "-o", packed}) != 0)
    throw std::invalid_argument("'" + file + "' is no network that can be sent; nothing was sent");
  std::ifstream in(packed, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

v1::NetworkOrder network_order_of(const NetworkArguments& arguments) {
  v1::NetworkOrder order;
  order.issuer(arguments.issuer);
  order.id(arguments.id);
  order.robot(arguments.robot);
  if (arguments.file.empty()) {
    order.order_kind(v1::NETWORK_SET_PARAMETER);
    order.parameter(arguments.parameter);
    order.amount(arguments.value);
    return order;
  }
  const std::string content = packed_network(arguments.file);
  order.order_kind(v1::NETWORK_REPLACE);
  order.content().assign(content.begin(), content.end());
  order.content_size(content.size());
  order.checksum(bytes::crc_32(content));
  return order;
}

int order_network(lib::Client& client, const NetworkArguments& arguments, bool as_json) {
  v1::NetworkOrder order = network_order_of(arguments);
  if (order.id().empty()) order.id(client.name());
  const auto last = client.send_network_order(
      order,
      [as_json](const v1::NetworkStatus& status) {
        std::cout << (as_json ? json_text(to_json(status)) : network_line(status)) << std::endl;
      },
      kAnswerLimit);
  if (!last) {
    std::cerr << "roci: no planner with a task network"
              << (arguments.robot.empty() ? "" : " of robot '" + arguments.robot + "'") << " answered within "
              << kAnswerLimit.count() / 1000
              << (client.view().mission() != nullptr ? kOnItsWay
                                                     : " s; is the mission running there (roci status)?\n");
    return kNoMission;
  }
  if (last->stage() == v1::NETWORK_REFUSED) return kRefused;
  if (last->stage() != v1::NETWORK_IN_FORCE)
    std::cerr << "roci: it is in force as soon as there is a plan with it (roci network status)\n";
  return kDone;
}

int show_networks(lib::Client& client, bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) {
    std::cerr << "roci: no mission answers; is it running there (roci status)?\n";
    return kNoMission;
  }
  client.catch_up();
  json list = json::array();
  for (const auto& [key, status] : client.networks()) {
    list.push_back(to_json(status));
    if (!as_json) std::cout << network_line(status) << "\n";
  }
  if (as_json) {
    std::cout << json_text(list) << "\n";
  } else if (list.empty()) {
    std::cout << "no planner of this mission has a task network\n";
  }
  return kDone;
}

std::string network_line(const v1::NetworkStatus& status) {
  const std::string network =
      status.network().empty() ? ""
                               : status.network() + ", version " + std::to_string(status.network_version());
  if (status.issuer().empty() && status.id().empty())
    return printable(status.planner() + " plans with " + network);
  std::string out = status.issuer() + "/" + status.id() + "  " + stage_name(status.stage());
  if (status.stage() == v1::NETWORK_IN_FORCE && status.plan_version() != 0)
    out += " with plan " + std::to_string(status.plan_version());
  if (!network.empty() && status.stage() != v1::NETWORK_REFUSED) out += ": " + network;
  out = printable(out);
  for (const std::string& reason : status.reasons()) out += "\n  " + printable(reason);
  return out;
}

}  // namespace roci::console::cli
