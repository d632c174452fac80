#include "services/link/link_file.hpp"

#include <algorithm>
#include <optional>
#include <set>

namespace roci::services::link {

using mission::Entry;
using mission::ServiceList;
using temporal::Time;

namespace {

constexpr double kLongestLightTimeS = 86400;  // Voyager 1 is not farther
constexpr double kLatestS = 30 * 366 * 86400.0;

std::string known_ends(const ServiceList& list) {
  std::string out = kGround;
  for (const std::string& robot : list.robots) out += ", " + robot;
  for (const std::string& service : list.names()) out += ", " + service;
  return out;
}

std::array<std::string, 2> read_ends(const Entry& entry, const ServiceList& list) {
  const std::vector<Entry> items = entry.items();
  if (items.size() != 2) entry.fail("a link has two ends; write for example ends: [ground, rover]");
  std::array<std::string, 2> ends;
  for (const std::size_t i : {0U, 1U}) {
    ends[i] = items[i].text();
    const bool known = ends[i] == kGround || list.find(ends[i]) != nullptr ||
                       std::ranges::find(list.robots, ends[i]) != list.robots.end();
    if (!known)
      items[i].fail("'" + ends[i] +
                    "' is neither a robot nor a service of this mission; choose of: " + known_ends(list));
  }
  if (ends[0] == ends[1]) items[1].fail("both ends are '" + ends[0] + "'; a link joins two");
  return ends;
}

double read_number(const Entry& link, const char* key, double least, double most, const char* range) {
  const auto entry = link.find(key);
  if (!entry) return 0;
  const double value = entry->number();
  if (value < least || value > most)
    entry->fail(std::string(key) + " is " + entry->text() + "; it must be " + range);
  return value;
}

Time read_time(const Entry& entry) {
  const double value = entry.number();
  if (value < 0 || value > kLatestS) entry.fail("expected seconds of mission time, from 0 to 30 years");
  return temporal::seconds(value);
}

std::vector<Interval> read_intervals(const Entry& link, const char* key) {
  std::vector<Interval> out;
  const auto list = link.find(key);
  if (!list) return out;
  for (const Entry& item : list->items()) {
    const std::vector<Entry> ends = item.items();
    if (ends.size() != 2) item.fail("expected [from, to], in seconds of mission time");
    const Interval interval{read_time(ends[0]), read_time(ends[1])};
    if (interval.second <= interval.first) item.fail("ends before it begins; swap the two");
    if (!out.empty() && interval.first < out.back().second)
      item.fail("begins before the one above has ended; sort or join them");
    out.push_back(interval);
  }
  if (out.empty()) list->fail(std::string(key) + " is empty; leave it out, or give at least one [from, to]");
  return out;
}

Link read_link(const Entry& entry, const ServiceList& list) {
  entry.allow_only({"name", "ends", "windows", "cuts", "light_time_s", "rate_bit_s", "loss"});
  Link link;
  link.ends = read_ends(entry.at("ends"), list);
  link.name = entry.text_or("name", link.ends[0] + "-" + link.ends[1]);
  link.open = Schedule(read_intervals(entry, "windows"), read_intervals(entry, "cuts"));
  link.light_time =
      temporal::seconds(read_number(entry, "light_time_s", 0, kLongestLightTimeS, "from 0 to 86400 s"));
  link.rate_bit_s = read_number(entry, "rate_bit_s", 1, 1e15, "at least 1 bit/s; leave it out for no limit");
  link.loss = read_number(entry, "loss", 0, 1, "a share from 0 to 1");
  return link;
}

}  // namespace

LinkTable read_links(const Entry& scenario, const ServiceList& list, std::uint64_t seed) {
  const auto entries = scenario.find("links");
  if (!entries) return {};
  std::vector<Link> links;
  std::set<std::string> names;
  std::set<std::set<std::string>> joined;
  for (const Entry& entry : entries->items()) {
    Link link = read_link(entry, list);
    if (!joined.insert({link.ends[0], link.ends[1]}).second)
      entry.at("ends").fail("a link above joins " + link.ends[0] + " and " + link.ends[1] +
                            " already; put both into one");
    if (!names.insert(link.name).second)
      entry.fail("a link above is called '" + link.name + "'; give it a name of its own");
    links.push_back(std::move(link));
  }
  std::map<std::string, std::string> robots;
  for (const mission::ServiceEntry& service : list.services) robots[service.name] = service.robot;
  return {std::move(links), std::move(robots), seed};
}

LinkTable load_links(const std::filesystem::path& mission_folder, const std::string& scenario,
                     std::uint64_t seed) {
  std::error_code error;
  const auto file = mission_folder / "scenarios" / (scenario + ".yaml");
  if (!std::filesystem::is_regular_file(file, error)) return {};
  const Entry root = Entry::load(file);
  if (!root.find("links")) return {};
  return read_links(root, mission::load_service_list(mission_folder), seed);
}

}  // namespace roci::services::link
