#include "tests/contract/support/two_hosts.hpp"

#include <chrono>
#include <stdexcept>

#include "tests/contract/support/child_process.hpp"

namespace roci::services::contract {
namespace {

void wait_for_link(const Host& host) {
  const std::vector<std::string> state{"cat", "/sys/class/net/" + host.link + "/operstate"};
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!ChildProcess(host.inside(state)).wait_for("up")) {
    if (std::chrono::steady_clock::now() > give_up) throw std::runtime_error(host.link + " does not come up");
  }
}

}  // namespace

void run_on_host(const std::vector<std::string>& command) {
  if (ChildProcess(command).finish() == 0) return;
  std::string text = "cannot set up network namespaces (it takes root):";
  for (const auto& word : command) text += " " + word;
  throw std::runtime_error(text);
}

std::vector<std::string> Host::inside(const std::vector<std::string>& command) const {
  std::vector<std::string> all{"ip", "netns", "exec", name};
  all.insert(all.end(), command.begin(), command.end());
  return all;
}

TwoHosts::TwoHosts() {
  try {
    run_on_host({"ip", "netns", "add", rover.name + "-probe"});
    run_on_host({"ip", "netns", "del", rover.name + "-probe"});
  } catch (const std::exception& error) {
    refused = error.what();
    return;
  }
  for (const auto& host : {rover, ground}) run_on_host({"ip", "netns", "add", host.name});
  run_on_host({"ip", "link", "add", rover.link, "netns", rover.name, "type", "veth", "peer", "name",
               ground.link, "netns", ground.name});
  for (const auto& host : {rover, ground}) {
    run_on_host(host.inside({"ip", "address", "add", host.address + "/24", "dev", host.link}));
    run_on_host(host.inside({"ip", "link", "set", host.link, "up"}));
    run_on_host(host.inside({"ip", "link", "set", "lo", "up"}));
  }
  for (const auto& host : {rover, ground}) wait_for_link(host);
}

TwoHosts::~TwoHosts() {
  if (!refused.empty()) return;
  for (const auto& host : {rover, ground}) ChildProcess({"ip", "netns", "del", host.name}).finish();
}

}  // namespace roci::services::contract
