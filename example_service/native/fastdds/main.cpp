// drill_svc: reads what the launcher says, and runs the drill.
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>

#include "drill.hpp"

namespace {

volatile std::sig_atomic_t stop = 0;

borehole::Options read(int argc, char** argv) {
  std::map<std::string, std::string> given;
  for (int i = 1; i + 1 < argc; ++i) given[argv[i]] = argv[i + 1];
  borehole::Options options;
  const auto text = [&](const char* key, const std::string& missing) {
    return given.contains(key) ? given[key] : missing;
  };
  options.name = text("--name", "drill_svc");
  options.run = text("--run", "");
  options.mission = std::filesystem::path(text("--mission", "")).filename();  // it has the name of its folder
  options.robot = text("--robot", "");
  options.domain = static_cast<std::uint32_t>(std::stoul(text("--domain", "0")));
  options.incarnation = static_cast<std::uint32_t>(std::stoul(text("--incarnation", "1")));
  options.simulated = text("--clock", "live") != "live";
  options.scale = std::stod(text("--scale", "1"));
  options.epoch_s = std::stod(text("--epoch", "0"));
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGTERM, [](int) { stop = 1; });
  std::signal(SIGINT, [](int) { stop = 1; });
  try {
    borehole::Participant participant(read(argc, argv));
    borehole::Clock clock(participant);
    const borehole::Drill drill(clock, participant.options());
    return clock.run(stop);
  } catch (const std::exception& error) {
    std::cerr << "drill_svc: " << error.what() << '\n';
    return 1;
  }
}
