#include "tests/scenario/radio_losses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

std::vector<json> lines_of(const fs::path& file) {
  std::vector<json> out;
  std::istringstream lines(text_of(file));
  for (std::string line; std::getline(lines, line);) out.push_back(json::parse(line));
  return out;
}

using Key = std::string;  // as link reports write it

template <class Sample>
Key key_of(const Sample& sample) {
  return sample.commander() + " " + std::to_string(sample.epoch()) + " " + sample.activity() + " " +
         std::to_string(sample.attempt());
}

// The last word of an executive on each of its activities.
std::map<std::string, v1::StepStatus> ends_of(const HeardFlight& flight) {
  std::map<std::string, v1::StepStatus> out;
  for (const v1::StepStatus& step : flight.steps) out[step.activity()] = step;
  return out;
}

}  // namespace

std::map<std::string, std::vector<json>> losses_of(const fs::path& run_folder) {
  std::map<std::string, std::vector<json>> out;
  for (const auto& file : fs::directory_iterator(run_folder / "links"))
    if (file.path().extension() == ".jsonl") out[file.path().stem()] = lines_of(file.path());
  return out;
}

void expect_asked_for(const HeardFlight& flight, const json& loss) {
  const auto later = [&](const v1::Command& command) {
    return key_of(command) == loss["key"] && command.header().seq() > loss["number"];
  };
  if (std::ranges::any_of(flight.commands, later)) return;
  const auto ends = ends_of(flight);
  const Key key = loss["key"];
  if (key.find(" fallback.") != Key::npos) return;  // repeated under its key until the component is inactive
  const auto step = std::ranges::find_if(ends, [&](const auto& one) {
    return key.find(" " + one.first + " ") != Key::npos || key.find("/" + one.first + "/") != Key::npos;
  });
  ASSERT_NE(step, ends.end()) << loss;
  if (loss["sender"] == "exec_svc") {
    EXPECT_THAT(step->second.cause(), HasSubstr("not answered")) << loss;
  }
}

void expect_all_named(const fs::path& run_folder, const std::string& service,
                      const std::vector<json>& losses) {
  std::map<std::string, int> counted, named;
  const json report = json::parse(text_of(run_folder / "links" / (service + ".json")));
  for (const auto& [link, counts] : report.items())
    for (const char* fate : {"lost", "superseded", "repeated"})
      counted[link + " " + fate] += counts.value(fate, 0);
  for (const json& loss : losses) {
    const std::string effect = loss["effect"];
    const std::string fate = effect == "superseded"   ? "superseded"
                             : effect == "sent again" ? "repeated"
                                                      : "lost";
    ++named[loss["link"].get<std::string>() + " " + fate];
  }
  std::erase_if(counted, [](const auto& one) { return one.second == 0; });
  EXPECT_EQ(named, counted) << service;
}

}  // namespace roci::scenario
