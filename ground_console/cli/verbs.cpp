#include "ground_console/cli/verbs.hpp"

#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "ground_console/cli/executed_table.hpp"
#include "ground_console/cli/plan_table.hpp"
#include "ground_console/cli/plan_values.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/timelines.hpp"

namespace roci::console::cli {
namespace {

using nlohmann::json;

v1::GoalClass importance_of(const std::string& text) {
  if (text == "hard") return v1::GOAL_HARD;
  if (text == "optional") return v1::GOAL_OPTIONAL;
  if (text == "opportunistic") return v1::GOAL_OPPORTUNISTIC;
  throw std::invalid_argument("unknown class '" + text + "'; one of: hard, optional, opportunistic");
}

v1::Property property_of(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw std::invalid_argument("argument '" + text + "' is not of the form name=value, e.g. x=110");
  }
  v1::Property out;
  out.name(text.substr(0, equals));
  out.value(text.substr(equals + 1));
  return out;
}

// With --executive somebody else may have answered.
int no_mission(const lib::MissionView& view) {
  const std::vector<std::string> known = view.executives();
  if (!known.empty() && view.mission() == nullptr) {
    std::cerr << "roci: there is no executive '" << printable(view.executive()) << "' in this run; it has:";
    for (const std::string& name : known) std::cerr << " " << printable(name);
    std::cerr << "\n";
    return kNoMission;
  }
  if (const std::string waiting = view.leaderless(); !waiting.empty()) {
    std::cerr << "roci: no executive leads: " << printable(waiting)
              << " is there and would, but an owner of commands is dead, cut off or led by the other one; "
                 "its log names the owner, "
                 "which has to be started or reached again\n";
    return kNoMission;
  }
  std::cerr << "roci: exec_svc did not answer within " << kAnswerLimit.count() / 1000
            << (view.mission() != nullptr ? kOnItsWay : " s; is the mission running there (roci status)?\n");
  return kNoMission;
}

void print_goal(const v1::GoalStatus& status, bool why, bool as_json) {
  if (as_json) {
    std::cout << json_text(to_json(status)) << std::endl;
    return;
  }
  std::cout << goal_line(status) << std::endl;
  if (const std::string details = details_of(status); why && !details.empty())
    std::cout << "  the planner: " << printable(details) << std::endl;
}

int report_goal(const lib::MissionView& view, const std::optional<v1::GoalStatus>& status, bool as_json) {
  if (!status) return no_mission(view);
  print_goal(*status, false, as_json);
  return is_refused(*status) ? kRefused : kDone;
}

// Prints each state that the goal comes to, until its last one.
int follow_goal(lib::Client& client, v1::GoalStatus status, const GoalArguments& arguments, bool as_json) {
  const lib::MissionView::GoalKey key{status.issuer(), status.id()};
  const auto newest = [&]() -> const v1::GoalStatus& { return client.view().goals().at(key); };
  for (;;) {
    switch (status.goal_state()) {
      case v1::GOAL_ACHIEVED:
        return kDone;
      case v1::GOAL_REJECTED:
        return kRefused;
      case v1::GOAL_DROPPED:
      case v1::GOAL_FAILED:
      case v1::GOAL_RECALLED:
        return kNotAchieved;
      case v1::GOAL_PENDING:
      case v1::GOAL_PLANNED:
        break;
    }
    const auto changed = [&] {
      return newest().goal_state() != status.goal_state() || newest().reason() != status.reason();
    };
    if (!client.wait([&] { return changed() || client.view().ended(); }, std::chrono::hours(24)) ||
        (!changed() && !client.wait(changed, std::chrono::milliseconds(500)))) {
      std::cerr << "roci: the mission ended before goal " << printable(key.second) << " did\n";
      return kStillOpen;
    }
    status = newest();
    print_goal(status, arguments.why, as_json);
  }
}

}  // namespace

v1::Goal goal_of(const GoalArguments& arguments) {
  v1::Goal goal;
  goal.issuer(arguments.issuer);
  goal.id(arguments.id);
  goal.goal_kind(arguments.kind);
  goal.robot(arguments.robot);
  for (const std::string& argument : arguments.arguments) {
    v1::Property property = property_of(argument);
    for (const v1::Property& before : goal.arguments())
      if (before.name() == property.name())
        throw std::invalid_argument("argument '" + property.name() + "' is given twice, as '" +
                                    before.value() + "' and as '" + property.value() + "'; leave one out");
    goal.arguments().push_back(std::move(property));
  }
  goal.importance(importance_of(arguments.importance));
  goal.utility(arguments.utility);
  goal.preferred_us(-1);
  goal.priority(arguments.priority);
  goal.opens_us(static_cast<std::int64_t>(arguments.opens_s * 1e6));
  goal.closes_us(static_cast<std::int64_t>(arguments.closes_s * 1e6));
  return goal;
}

int add_goal(lib::Client& client, const GoalArguments& arguments, bool as_json) {
  const v1::Goal goal = goal_of(arguments);
  const auto status = client.send_goal(goal, kAnswerLimit);
  const int code = report_goal(client.view(), status, as_json);
  return code == kDone && arguments.waits ? follow_goal(client, *status, arguments, as_json) : code;
}

int cancel_goal(lib::Client& client, const std::string& issuer, const std::string& id, bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) return no_mission(client.view());
  const lib::MissionView::GoalKey key{issuer, id};
  if (!client.wait([&] { return client.view().goals().contains(key); }, std::chrono::seconds(2))) {
    std::cerr << "roci: there is no goal " << issuer << "/" << id << "; see roci goal list\n";
    return kRefused;
  }
  v1::Goal goal;
  if (const v1::Goal* known = client.view().goal(key)) goal = *known;
  goal.issuer(issuer);
  goal.id(id);
  goal.recalled(true);
  const auto status = client.send_goal(goal, kAnswerLimit);
  return report_goal(client.view(), status, as_json);
}

int list_goals(lib::Client& client, bool why, bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) return no_mission(client.view());
  client.catch_up();
  json list = json::array();
  for (const auto& [key, status] : client.view().goals()) {
    if (as_json) {
      list.push_back(to_json(status));
    } else {
      print_goal(status, why, false);
    }
  }
  if (as_json) std::cout << json_text(list) << "\n";
  return kDone;
}

int show_status(lib::Client& client, const MissionWords& words, bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) return no_mission(client.view());
  client.settle();
  std::cout << (as_json ? json_text(status_json(client.view())) + "\n" : status_text(client.view(), words));
  return kDone;
}

namespace {

// What is seen is one executive's; where there are more, who reads is told whose.
void tell_whose(const lib::MissionView& view) {
  const std::vector<std::string> executives = view.executives();
  if (executives.size() < 2) return;
  std::cerr << "roci: " << view.executive() << " of";
  for (const std::string& name : executives) std::cerr << " " << printable(name);
  std::cerr << "; --executive chooses\n";
}

}  // namespace

namespace {

// What activities of this id or name stand on.
int show_values(const lib::MissionView& view, const std::string& name, bool as_json) {
  const auto activities = activities_named(view, name);
  if (activities.empty()) {
    std::cerr << "roci: the running plan has no activity '" << printable(name)
              << "'; roci plan lists them, by id and by what they do\n";
    return kRefused;
  }
  if (!as_json) {
    std::cout << values_text(view, activities);
    return kDone;
  }
  json list = json::array();
  for (const v1::PlanActivity* activity : activities)
    list.push_back({{"id", activity->id()},
                    {"name", activity->name()},
                    {"function_values", values_json(view, *activity)}});
  std::cout << json_text(list) << "\n";
  return kDone;
}

}  // namespace

int show_executed(lib::Client& client, std::uint32_t version, bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) return no_mission(client.view());
  client.wait([&] { return !client.view().executed().empty(); }, std::chrono::milliseconds(1000));
  client.catch_up();
  tell_whose(client.view());
  const auto& plans = client.view().executed();
  const auto found = version == 0 && !plans.empty() ? std::prev(plans.end()) : plans.find(version);
  if (found == plans.end()) {
    std::cerr << "roci: "
              << (version == 0
                      ? "no plan"
                      : "plan " + std::to_string(version) + " has not ended, or is forgotten; no plan")
              << (plans.empty() ? " has ended yet\n" : " but the last ones is kept; see roci executed\n");
    return kRefused;
  }
  std::cout << (as_json ? json_text(executed_json(found->second)) + "\n" : executed_table(found->second));
  return kDone;
}

int show_plan(lib::Client& client, const std::string& why, bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) return no_mission(client.view());
  client.wait([&] { return client.view().plan() != nullptr; }, std::chrono::milliseconds(1000));
  client.settle();
  tell_whose(client.view());
  if (!why.empty()) return show_values(client.view(), why, as_json);
  if (as_json) {
    std::cout << json_text(plan_json(client.view())) << "\n";
    return kDone;
  }
  std::cout << plan_table(client.view());
  return kDone;
}

int show_timelines(lib::Client& client, const std::vector<std::string>& names, const MissionWords& words,
                   bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) return no_mission(client.view());
  client.wait([&] { return client.view().plan() != nullptr; }, std::chrono::milliseconds(1000));
  client.catch_up();
  tell_whose(client.view());
  const Timelines timelines = timelines_of(client.view(), names);
  for (const std::string& name : names) {
    if (timelines.contains(name)) continue;
    std::cerr << "roci: nothing is known of timeline '" << name << "'; see roci timelines\n";
    return kRefused;
  }
  if (as_json) {
    std::cout << json_text(timelines_json(client.view(), timelines, words)) << "\n";
  } else {
    std::cout << (names.empty() ? timelines_table(timelines, words) : timelines_text(timelines, words));
  }
  return kDone;
}

int follow_events(lib::Client& client, std::size_t count, bool as_json) {
  std::uint64_t printed = 0;
  const auto ended = [&] { return client.over(); };
  for (bool last = false; !last;) {
    last = client.wait([&] { return client.view().events_seen() > printed || ended(); },
                       std::chrono::hours(24)) &&
           ended();
    const auto& events = client.view().events();
    std::size_t fresh = std::min<std::size_t>(events.size(), client.view().events_seen() - printed);
    for (; fresh > 0; --fresh) {
      const v1::Event& event = events[events.size() - fresh];
      std::cout << (as_json ? json_text(to_json(event)) : event_line(event)) << std::endl;
      if (++printed == count && count != 0) return kDone;
    }
    printed = client.view().events_seen();
  }
  return kDone;
}

}  // namespace roci::console::cli
