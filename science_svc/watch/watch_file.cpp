#include "science_svc/watch/watch_file.hpp"

#include <algorithm>
#include <string>

#include "core/words/nearest_word.hpp"

namespace roci::science::watch {
namespace {

using mission::Entry;

GoalClass read_class(const Entry& entry) {
  const std::string word = entry.text();
  if (word == "hard") return GoalClass::hard;
  if (word == "optional") return GoalClass::optional;
  if (word == "opportunistic") return GoalClass::opportunistic;
  entry.fail("'" + word + "' is no class of goals; one of: hard, optional, opportunistic" +
             words::did_you_mean(word, {"hard", "optional", "opportunistic"}));
}

Rule read_rule(const Entry& entry) {
  entry.allow_only({"timeline", "state", "goal_kind", "arguments", "class", "utility"});
  Rule out;
  out.timeline = entry.at("timeline").text();
  if (std::ranges::count(out.timeline, '*') > 1)
    entry.at("timeline").fail("'" + out.timeline + "' has more than one *; keep the one that stands for the object");
  out.state = entry.at("state").text();
  out.goal_kind = entry.at("goal_kind").text();
  if (const auto arguments = entry.find("arguments"))
    for (const auto& [name, value] : arguments->fields()) {
      out.arguments[name] = value.text();
      if (value.text().find('*') != std::string::npos && out.timeline.find('*') == std::string::npos)
        value.fail("nothing stands for the * of '" + value.text() + "'; put a * into 'timeline'");
    }
  if (const auto word = entry.find("class")) out.importance = read_class(*word);
  out.utility = entry.number_or("utility", out.utility);
  return out;
}

}  // namespace

std::vector<Rule> read_rules(const Entry& mission) {
  std::vector<Rule> out;
  if (const auto list = mission.find("watch")) list->each([&](const Entry& item) { out.push_back(read_rule(item)); });
  return out;
}

}  // namespace roci::science::watch
