#include "core/mission/service_list.hpp"

#include <algorithm>
#include <cctype>

#include "core/mission/mission_file.hpp"
#include "core/words/nearest_word.hpp"

namespace roci::mission {
namespace {

constexpr char kMissionFile[] = "mission.yaml";

bool is_name(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
}

void require_name(const Entry& entry, const std::string& name, const std::string& what) {
  if (!is_name(name))
    entry.fail("'" + name + "' is no name of a " + what + "; use letters, digits, _ - and .");
}

std::vector<std::string> read_robots(const Entry& mission) {
  std::vector<std::string> robots;
  const auto list = mission.find("robots");
  if (!list) return robots;
  list->each([&](const Entry& entry) {
    const std::string name = entry.text();
    require_name(entry, name, "robot");
    if (std::ranges::find(robots, name) != robots.end()) entry.fail("robot '" + name + "' stands twice");
    robots.push_back(name);
  });
  return robots;
}

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out.empty() ? "none" : out;
}

void read_robot(const Entry& entry, const std::vector<std::string>& robots, ServiceEntry& out) {
  const auto robot = entry.find("robot");
  if (!robot) return;
  out.robot = robot->text();
  if (std::ranges::find(robots, out.robot) == robots.end())
    robot->complain("no robot '" + out.robot + "' stands in robots:; known: " + joined(robots) +
                    words::did_you_mean(out.robot, robots));
}

void require_file(const Entry& entry, const std::filesystem::path& file, const char* what) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    entry.complain(std::string("there is no ") + what + " " + file.string() +
                   "; correct the name, or put it there");
}

ServiceEntry read_service(const Entry& entry, const Entry& mission, const std::vector<std::string>& robots) {
  entry.allow_only({"name", "program", "robot", "vendor", "settings", "clock", "standby", "essential",
                    "arguments", "rights"});
  ServiceEntry out;
  out.name = entry.at("name").text();
  require_name(entry.at("name"), out.name, "service");
  out.program = entry.text_or("program", out.name);
  if (out.program.find('/') != std::string::npos) {
    const std::filesystem::path file = entry.resolve(out.program);
    require_file(entry.at("program"), file, "program");
    out.program = file.string();
  }
  read_robot(entry, robots, out);
  out.vendor = entry.text_or("vendor", "");
  out.settings = mission.resolve(kMissionFile);  // not that of its base
  if (const auto settings = entry.find("settings")) {
    out.settings = settings->resolve(settings->text());
    require_file(*settings, out.settings, "settings file");
  }
  if (const auto clock = entry.find("clock")) {
    if (clock->text() != "master") clock->complain("clock: " + clock->text() + "; the only value is master");
    out.clock_master = true;
  }
  out.paired = entry.truth_or("standby", false);
  out.essential = entry.truth_or("essential", true);
  if (!out.essential && out.clock_master)
    entry.at("essential").fail("nothing goes on without the clock; its master is essential");
  if (const auto arguments = entry.find("arguments")) out.arguments = arguments->texts();
  if (const auto rights = entry.find("rights")) out.rights = rights->texts();
  return out;
}

}  // namespace

const ServiceEntry* ServiceList::find(std::string_view name) const {
  const auto found = std::ranges::find(services, name, &ServiceEntry::name);
  return found == services.end() ? nullptr : &*found;
}

std::vector<std::string> ServiceList::names() const {
  std::vector<std::string> out;
  for (const ServiceEntry& service : services) out.push_back(service.name);
  return out;
}

const ServiceEntry* ServiceList::clock_master() const {
  const auto found = std::ranges::find(services, true, &ServiceEntry::clock_master);
  return found == services.end() ? nullptr : &*found;
}

std::vector<const ServiceEntry*> ServiceList::of_program(std::string_view program) const {
  std::vector<const ServiceEntry*> out;
  const auto name = std::filesystem::path(program).filename();
  for (const ServiceEntry& service : services)
    if (std::filesystem::path(service.program).filename() == name) out.push_back(&service);
  return out;
}

std::string ServiceList::file_name(std::string_view service, const std::string& name) const {
  const ServiceEntry* entry = find(service);
  if (entry == nullptr || of_program(entry->program).size() == 1) return name;
  return entry->name + "." + name;
}

std::string ServiceList::serving(std::string_view program, std::string_view robot) const {
  const auto only = [&](std::string_view of) {
    std::string name;
    for (const ServiceEntry& service : services) {
      if (service.robot != of || std::filesystem::path(service.program).filename() != program) continue;
      if (!name.empty()) return std::string();
      name = service.name;
    }
    return name;
  };
  const std::string own = only(robot);
  return own.empty() && !robot.empty() ? only("") : own;
}

ServiceList read_service_list(const Entry& mission) {
  ServiceList out;
  out.robots = read_robots(mission);
  const auto list = mission.find("services");
  if (!list || list->items().empty()) {
    mission.fail(
        "the mission names no services; add for example\n"
        "  services:\n"
        "    - {name: sim_svc, clock: master}\n"
        "    - {name: exec_svc}");
  }
  list->each([&](const Entry& entry) {
    ServiceEntry service = read_service(entry, mission, out.robots);
    if (out.find(service.name) != nullptr)
      entry.at("name").fail("service '" + service.name + "' stands twice");
    out.services.push_back(std::move(service));
  });
  if (std::ranges::count(out.services, true, &ServiceEntry::clock_master) > 1)
    list->complain("several services have clock: master; one alone drives the simulated clock");
  return out;
}

ServiceList load_service_list(const std::filesystem::path& mission_folder) {
  return read_service_list(load_mission_file(mission_folder));
}

ServiceList load_service_list_if_any(const std::filesystem::path& mission_folder) {
  const Entry mission = load_mission_file(mission_folder);
  return mission.find("services") ? read_service_list(mission) : ServiceList{};
}

}  // namespace roci::mission
