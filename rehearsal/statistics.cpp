#include "rehearsal/statistics.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

namespace roci::rehearsal {
namespace {

void for_each_line(const std::filesystem::path& file,
                   const std::function<void(const nlohmann::json&)>& take) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto read = nlohmann::json::parse(line, nullptr, false);
    if (read.is_object()) take(read);
  }
}

// Names the effect with what it was done to; an activity of a plan, whose number is another one in each flight, is
// nothing to compare.
std::string name_of(const nlohmann::json& effect) {
  const std::string object = effect.value("object", "");
  const bool activity = object.find('#') != std::string::npos || object == effect.value("activity", "");
  return effect.value("kind", "") + (object.empty() || activity ? "" : " " + object);
}

std::string listed(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> all(counts.begin(), counts.end());
  std::ranges::stable_sort(all, std::greater{}, [](const auto& one) { return one.second; });
  std::string out;
  for (const auto& [name, count] : all) out += (out.empty() ? "" : ", ") + name + " " + std::to_string(count);
  return out;
}

}  // namespace

void Statistics::add(const std::filesystem::path& run_folder, const std::string& result) {
  ++flights_;
  ++results_[result];
  std::set<std::string> done, received;
  for_each_line(run_folder / "effects.jsonl",
                [&](const nlohmann::json& effect) { done.insert(name_of(effect)); });
  for_each_line(run_folder / "products.jsonl", [&](const nlohmann::json& product) {
    if (product.value("fate", "") == "received") received.insert(product.value("kind", ""));
  });
  for (const std::string& one : done) ++done_[one];
  for (const std::string& one : received) ++received_[one];
}

std::string Statistics::text() const {
  const std::string of = "of " + std::to_string(flights_) + " flights";
  std::string out = of + " ended: " + listed(results_) + "\n";
  if (!done_.empty()) out += of + " did: " + listed(done_) + "\n";
  if (!received_.empty()) out += of + " brought home: " + listed(received_) + "\n";
  return out;
}

nlohmann::json Statistics::json() const {
  return {{"results", results_}, {"done", done_}, {"received", received_}};
}

}  // namespace roci::rehearsal
