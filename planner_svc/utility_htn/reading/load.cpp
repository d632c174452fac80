#include "planner_svc/utility_htn/reading/load.hpp"

#include <fstream>
#include <sstream>
#include <string>

#include "core/mission/entry.hpp"
#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/check.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"
#include "planner_svc/utility_htn/reading/yaml.hpp"

namespace roci::planner::utility_htn::reading {

using mission::Finding, mission::Findings, mission::Severity;
using model::Network;

namespace {

Finding refusal(const std::filesystem::path& file, const std::string& text) {
  Finding out;
  out.file = file.string();
  const std::size_t remedy = text.find("; ");
  out.what = text.substr(0, remedy);
  if (remedy != std::string::npos) out.remedy = text.substr(remedy + 2);
  return out;
}

// Notes what the check finds, at the place of the part, or at the file's.
bool note_faults(const Network& network, const std::filesystem::path& file, const Places& places,
                 Findings& findings) {
  const std::vector<model::Fault> faults = model::check(network);
  for (const model::Fault& fault : faults) {
    const auto place = places.find({fault.part, fault.index});
    const Finding at = mission::finding_of((place == places.end() ? file.string() : place->second) + ": .");
    Finding finding = refusal(at.file, to_text(fault, network));
    finding.line = at.line;
    finding.column = at.column;
    finding.severity = fault.warning ? Severity::warning : Severity::error;
    findings.add(std::move(finding));
  }
  return model::usable(faults);
}

std::optional<std::string> contents(const std::filesystem::path& file, Findings& findings) {
  std::error_code error;
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file, error)) {
    findings.add(refusal(file, "cannot be read; check that the file exists"));
    return std::nullopt;
  }
  std::string out(model::kMostBytes + 1, '\0');
  in.read(out.data(), static_cast<std::streamsize>(out.size()));
  out.resize(static_cast<std::size_t>(in.gcount()));
  if (out.size() <= model::kMostBytes) return out;
  findings.add(
      refusal(file, "more than " + std::to_string(model::kMostBytes) + " bytes; make the network smaller"));
  return std::nullopt;
}

}  // namespace

std::optional<Network> take_network(std::string_view bytes, const std::filesystem::path& name,
                                    Findings& findings) {
  try {
    Network network = parse_binary(bytes);
    if (note_faults(network, name, {}, findings)) return network;
  } catch (const BinaryError& error) {
    findings.add(refusal(name, error.what()));
  }
  return std::nullopt;
}

std::optional<Network> load_network(const std::filesystem::path& file, Findings& findings) {
  const auto bytes = contents(file, findings);
  if (!bytes) return std::nullopt;
  if (is_binary(*bytes)) return take_network(*bytes, file, findings);
  Read read = read_yaml(file, findings);
  if (!read.network || !note_faults(*read.network, file, read.places, findings)) return std::nullopt;
  return std::move(read.network);
}

Network load_network(const std::filesystem::path& file) {
  Findings findings;
  std::optional<Network> network = load_network(file, findings);
  if (network) return std::move(*network);
  std::string text;
  for (const Finding& finding : findings.sorted()) {
    if (finding.severity != Severity::error) continue;
    text +=
        (text.empty() ? "" : "\n") + finding.text() + (finding.remedy.empty() ? "" : "; " + finding.remedy);
  }
  throw mission::FileError(text);
}

}  // namespace roci::planner::utility_htn::reading
