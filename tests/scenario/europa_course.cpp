#include "tests/scenario/europa_course.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {

using nlohmann::json;

Course::Course(const std::filesystem::path& run_folder) {
  std::ifstream in(run_folder / "effects.jsonl");
  for (std::string line; std::getline(in, line);) {
    const auto deed = json::parse(line);
    deeds_.push_back({deed["time_us"].get<double>() / 1e6, deed.value("kind", ""), deed.value("object", ""),
                      deed.value("activity", "")});
  }
  read_products(run_folder / "products.jsonl");
}

void Course::read_products(const std::filesystem::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto told = json::parse(line);
    const std::string id = told.value("id", ""), fate = told.value("fate", "");
    auto known = std::ranges::find(products_, id, &Product::id);
    if (known == products_.end())
      known = products_.insert(known, {id, told.value("kind", ""), told.value("source", ""),
                                       told.value("tier", ""), told.value("bytes", 0.0)});
    const double at_s = told["time_us"].get<double>() / 1e6;
    if (fate == "stored") known->made_s = at_s;
    if (fate == "sent") known->sent_s = at_s;
    if (fate == "received") known->received_s = at_s;
  }
}

std::vector<std::string> Course::samples_at(const std::string& site) const {
  std::vector<std::string> out;
  for (const std::string& one : samples())
    if (one.starts_with(site + " ")) out.push_back(one);
  return out;
}

bool Course::is_home(const std::string& product_kind) const {
  return std::ranges::any_of(
      products_, [&](const Product& one) { return one.kind == product_kind && one.received_s >= 0; });
}

std::vector<std::string> Course::objects(const std::string& kind) const {
  std::vector<std::string> out;
  for (const Deed& deed : deeds_)
    if (deed.kind == kind) out.push_back(deed.object);
  return out;
}

double Course::last(const std::string& kind) const {
  double out = -1;
  for (const Deed& deed : deeds_)
    if (deed.kind == kind) out = deed.at_s;
  return out;
}

std::pair<int, int> Course::blocks_and_those_unreleased() const {
  std::pair<int, int> out;
  bool released = false, discarded = false;
  for (const Deed& deed : deeds_) {
    released |= deed.kind == "receive" && deed.object.starts_with("p_uplink_");
    const bool collects = deed.kind == "collect", discards = deed.kind == "discard";
    if (deed.kind != "excavate" && !collects && !discards) continue;
    if (collects && std::exchange(discarded, false)) continue;  // the same block
    discarded = discards;
    ++out.first;
    if (!std::exchange(released, false)) ++out.second;
  }
  return out;
}

namespace {

// Words of each line of the flight's own trace, behind its time in seconds.
std::vector<std::pair<double, std::vector<std::string>>> trace_of(const std::filesystem::path& run_folder) {
  std::vector<std::pair<double, std::vector<std::string>>> out;
  std::istringstream lines(run("roci-trace print " + (run_folder / "journal.sqlite").string()).output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream text(line);
    double at_us = 0;
    if (!(text >> at_us)) continue;  // the first line
    out.push_back({at_us / 1e6, {std::istream_iterator<std::string>(text), {}}});
  }
  return out;
}

}  // namespace

std::map<std::string, std::vector<Reading>> readings(const std::filesystem::path& run_folder,
                                                     const std::string& prefix) {
  std::map<std::string, std::vector<Reading>> out;
  for (const auto& [at_s, words] : trace_of(run_folder))
    if (words.size() > 2 && words[0] == "observation" && words[1].starts_with(prefix))
      out[words[1]].push_back({at_s, words[2]});
  return out;
}

std::map<std::string, std::vector<std::string>> observed(const std::filesystem::path& run_folder,
                                                         const std::string& prefix) {
  std::map<std::string, std::vector<std::string>> out;
  for (const auto& [timeline, told] : readings(run_folder, prefix))
    for (const Reading& one : told) out[timeline].push_back(one.value);
  return out;
}

std::vector<double> ordered_at(const std::filesystem::path& run_folder) {
  std::vector<double> out;
  for (const auto& [at_s, words] : trace_of(run_folder))
    if (!words.empty() && words[0] == "order") out.push_back(at_s);
  return out;
}

std::vector<Session> sessions(const std::filesystem::path& run_folder) {
  std::vector<Session> out;
  std::optional<double> since;
  for (const Reading& one : readings(run_folder, "lander.radio")["lander.radio"]) {
    const bool sends = one.value == "sending";
    if (since && !sends) out.push_back({*std::exchange(since, std::nullopt), one.at_s});
    if (sends && !since) since = one.at_s;
  }
  return out;
}

}  // namespace roci::scenario
