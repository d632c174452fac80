#include "planner_svc/utility_htn/reading/unknown_names.hpp"

#include <algorithm>
#include <tuple>

#include "core/mission/told_error.hpp"

namespace roci::planner::utility_htn::reading {

using mission::Finding, mission::ToldError;

namespace {

constexpr std::size_t kNamedPlaces = 5;

// "31, 41 and 3 more"; a place in another file in full.
std::string listed(const std::vector<Finding>& places, const std::string& file) {
  std::string out;
  for (std::size_t i = 0; i < std::min(places.size(), kNamedPlaces); ++i) {
    const std::string line = std::to_string(places[i].line);
    out += (i > 0 ? ", " : "") + (places[i].file == file ? line : places[i].file + ":" + line);
  }
  return out + (places.size() > kNamedPlaces
                    ? " and " + std::to_string(places.size() - kNamedPlaces) + " more"
                    : "");
}

}  // namespace

void UnknownNames::fail(Unknown unknown, const Source& source) {
  ++failures_;
  const std::string place = source.entry().place();
  const auto [known, is_new] = known_.try_emplace({unknown.kind, unknown.name}, all_.size());
  if (is_new) all_.push_back({std::move(unknown), {}});
  Occurrences& occurrences = all_[known->second];
  if (std::ranges::find(occurrences.places, place) == occurrences.places.end())
    occurrences.places.push_back(place);
  throw ToldError(place + ": " + occurrences.unknown.what + "; " + occurrences.unknown.remedy);
}

void UnknownNames::fail_again(const Source& source) {
  ++failures_;
  throw ToldError(source.entry().place() + ": it stands on an entry with a fault; mend that one");
}

void UnknownNames::report(mission::Findings& findings, std::size_t most) const {
  std::set<std::string> told;
  for (const Occurrences& occurrences : all_) {
    if (hidden_.contains(occurrences.unknown.kind)) continue;
    std::vector<Finding> places;
    for (const std::string& place : occurrences.places)
      if (told.insert(place).second) places.push_back(mission::finding_of(place + ": ."));
    if (places.empty() || findings.errors() >= most) continue;
    std::ranges::sort(places, {}, [](const Finding& at) { return std::tie(at.file, at.line, at.column); });
    Finding finding = places.front();
    finding.what = occurrences.unknown.what;
    finding.remedy = occurrences.unknown.remedy;
    places.erase(places.begin());
    if (!places.empty())
      finding.remedy += std::string("; it stands in line") + (places.size() > 1 ? "s " : " ") +
                        listed(places, finding.file) + ", too";
    findings.add(std::move(finding));
  }
}

}  // namespace roci::planner::utility_htn::reading
