#include "sim_svc/setup/settings.hpp"

#include <utility>

#include "core/words/nearest_word.hpp"

namespace roci::sim::setup {

using mission::Entry;

Settings::Settings(Entry mission, Entry component, std::optional<Entry> start,
                   const std::map<std::string, Entry>& conditions)
    : mission_(std::move(mission)),
      component_(std::move(component)),
      start_(std::move(start)),
      conditions_(conditions) {}

std::optional<Entry> Settings::find(std::string_view key) {
  known_.emplace(key);
  const auto condition = conditions_.find(std::string(key));
  if (condition != conditions_.end()) return condition->second;
  return component_.find(key);
}

namespace {

double checked(const std::optional<Entry>& entry, std::string_view key, double fallback, double least) {
  if (!entry) return fallback;
  const double value = entry->number();
  if (value < least) {
    entry->fail("'" + std::string(key) + "' must be at least " + std::to_string(least) +
                "; correct the number");
  }
  return value;
}

}  // namespace

double number(const Entry& section, std::string_view key, double fallback, double least) {
  return checked(section.find(key), key, fallback, least);
}

void check_name(const std::string& name, const Entry& where) {
  if (name.empty() || name.find_first_of(". *{}") != std::string::npos)
    where.fail("'" + name + "' is no name for a timeline; use letters, digits, - and _");
}

double Settings::number(std::string_view key, double fallback, double least) {
  return checked(find(key), key, fallback, least);
}

double Settings::share(std::string_view key, double fallback) {
  const double value = number(key, fallback);
  if (value > 1) find(key)->fail("'" + std::string(key) + "' is a share, at most 1; correct the number");
  return value;
}

std::string Settings::text(std::string_view key, std::string fallback) {
  const auto entry = find(key);
  return entry ? entry->text() : fallback;
}

const std::optional<Entry>& Settings::start() {
  start_read_ = true;
  return start_;
}

void Settings::refuse_unknown() const {
  refuse_unknown_keys(component_, known_);
  if (start_ && !start_read_) start_->fail("this component has no choice of how it starts; drop the key");
}

void refuse_unknown_keys(const Entry& entry, const std::set<std::string, std::less<>>& known) {
  for (const auto& [key, value] : entry.fields()) {
    if (known.contains(key)) continue;
    std::string list;
    for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
    value.complain("unknown key '" + key + "'; known here: " + list +
                   words::did_you_mean(key, {known.begin(), known.end()}));
  }
}

}  // namespace roci::sim::setup
