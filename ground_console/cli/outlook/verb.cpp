#include "ground_console/cli/outlook/verb.hpp"

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "ground_console/cli/outlook/outlook.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/verbs.hpp"

namespace roci::console::cli::outlook {
namespace {

using nlohmann::json;

template <class Sample>
struct Views {
  std::string (*text)(const Sample&);
  json (*to_json)(const Sample&);
  std::string (*svg)(const Sample&);
};

Views<v1::MissionOutlook> views_of(Subject subject) {
  if (subject == Subject::energy) return {energy_text, energy_json, energy_svg};
  if (subject == Subject::chains) return {chains_text, chains_json, chains_svg};
  if (subject == Subject::subway) return {subway_text, subway_json, subway_svg};
  return {utility_text, utility_json, utility_svg};
}

void write_picture(const std::string& file, const std::string& picture) {
  std::ofstream out(file, std::ios::binary);
  if (!(out << picture << std::flush))
    throw std::invalid_argument("'" + file +
                                "' cannot be written; name a file in a folder of yours with --svg");
}

template <class Sample>
const Sample* chosen(const std::map<std::string, Sample>& all, const std::string& robot) {
  if (robot.empty() && !all.empty()) return &all.begin()->second;
  const auto found = all.find(robot);
  return found == all.end() ? nullptr : &found->second;
}

template <class Sample>
int show(lib::Client& client, const std::map<std::string, Sample>& all, const Views<Sample>& views,
         const OutlookArguments& arguments, bool as_json) {
  if (client.wait([&] { return chosen(all, arguments.robot) != nullptr; }, std::chrono::milliseconds(2000)))
    client.catch_up();
  const Sample* const sample = chosen(all, arguments.robot);
  if (sample == nullptr) {
    std::cerr << "roci: no planner tells of this"
              << (arguments.robot.empty() ? "" : " for robot '" + printable(arguments.robot) + "'")
              << "; only one that plans from a task network does, from its first plan on\n";
    return kRefused;
  }
  if (!arguments.svg.empty()) {
    write_picture(arguments.svg, views.svg(*sample));
    if (!as_json) return kDone;
  }
  std::cout << (as_json ? json_text(views.to_json(*sample)) + "\n" : views.text(*sample));
  return kDone;
}

}  // namespace

int show_outlook(lib::Client& client, const OutlookArguments& arguments, bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) {
    std::cerr << "roci: no mission answers; is it running there (roci status)?\n";
    return kNoMission;
  }
  if (arguments.subject == Subject::downlinks)
    return show<v1::DownlinkSchedule>(client, client.view().schedules(),
                                      {downlinks_text, downlinks_json, downlinks_svg}, arguments, as_json);
  return show(client, client.view().outlooks(), views_of(arguments.subject), arguments, as_json);
}

}  // namespace roci::console::cli::outlook
