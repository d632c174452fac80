#include "services/process/link_report.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "services/topics/topics.hpp"

namespace roci::services::process {

using nlohmann::json;

namespace {

constexpr char kFolder[] = "links";

// What is no number in a damaged report counts as 0.
std::uint64_t count_of(const json& report, const char* name) {
  const auto found = report.find(name);
  return found != report.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

link::Counts counts_of(const json& report) {
  return {count_of(report, "offered"),    count_of(report, "arrived"),   count_of(report, "lost"),
          count_of(report, "superseded"), count_of(report, "under_way"), count_of(report, "repeated")};
}

json as_json(const link::LostSample& sample) {
  return {{"time_us", sample.at.count()}, {"link", sample.link},
          {"topic", sample.topic},        {"key", sample.key},
          {"sender", sample.sender},      {"incarnation", sample.incarnation},
          {"number", sample.number},      {"attempt", sample.attempt},
          {"effect", effect_of(sample)}};
}

}  // namespace

const char* effect_of(const link::LostSample& sample) {
  if (sample.fate == link::Fate::repeated) return "sent again";
  if (sample.fate == link::Fate::superseded) return "superseded";
  const std::string& topic = sample.topic;
  if (topic == topics::command.name) return "asked for";
  if (topic == topics::call_cancel.name) return "answered in vain";
  if (topic.ends_with("/request") || topic.ends_with("/reply")) return "called again";
  if (topic == topics::plan_delta.name) return "made up for by a newer version";
  return "never heard";
}

json as_json(const std::map<std::string, link::Counts>& links) {
  json out = json::object();
  for (const auto& [name, counts] : links) {
    out[name] = {{"offered", counts.offered},     {"arrived", counts.arrived},
                 {"lost", counts.lost},           {"superseded", counts.superseded},
                 {"under_way", counts.under_way}, {"repeated", counts.repeated}};
  }
  return out;
}

void write_link_report(const Node& node, const std::filesystem::path& run_folder) {
  const auto counts = node.link_counts();
  if (counts.empty() || run_folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(run_folder / kFolder, error);
  const std::string& name = node.options().name;
  std::ofstream(run_folder / kFolder / (name + ".json")) << as_json(counts).dump(2) << '\n';
  if (node.lost_samples().empty()) return;
  std::ofstream lost(run_folder / kFolder / (name + ".jsonl"));
  for (const link::LostSample& sample : node.lost_samples())
    lost << as_json(sample).dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
}

std::map<std::string, link::Counts> read_link_reports(const std::filesystem::path& run_folder) {
  std::map<std::string, link::Counts> out;
  std::error_code missing;
  for (const auto& file : std::filesystem::directory_iterator(run_folder / kFolder, missing)) {
    if (file.path().extension() != ".json") continue;
    std::ifstream in(file.path());
    const json report = json::parse(in, nullptr, false);
    if (!report.is_object()) continue;
    for (const auto& [name, counts] : report.items())
      if (counts.is_object()) out[name] += counts_of(counts);
  }
  return out;
}

}  // namespace roci::services::process
