#include "dedicated_svc/methods/methods_file.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "core/mission/bounded_number.hpp"
#include "dedicated_svc/methods/fill.hpp"

namespace roci::dedicated::methods {
namespace {

using mission::Entry;

constexpr double kLongestWait = 1e7;  // seconds
constexpr double kLongestCut = 1000;  // metres
constexpr char kEnd[] = "end";        // a repair goes on with no call

// What a template may name here: arguments of the command, and calls whose values it has.
struct Known {
  std::set<std::string> arguments;
  std::set<std::string> calls;
};

Template read_template(const Entry& entry, const Known& known) {
  const std::string text = entry.text();
  const auto names = names_in(text);
  if (!names) entry.fail("'" + text + "' has braces that do not match; write {argument} or {call.value}");
  for (const std::string& name : *names) {
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos) {
      if (!known.arguments.contains(name))
        entry.fail("'{" + name + "}' is no argument of this command; list it under 'arguments'");
    } else if (!known.calls.contains(name.substr(0, dot))) {
      entry.fail("'{" + name + "}' names no call that has ended by then; values come from calls further up");
    }
  }
  return text;
}

Template template_or_none(const Entry& entry, std::string_view key, const Known& known) {
  const auto value = entry.find(key);
  return value ? read_template(*value, known) : Template{};
}

Place read_place(const Entry& entry, const Known& known) {
  entry.allow_only({"object", "robot", "x", "y", "ahead_m", "left_m"});
  Place place{template_or_none(entry, "object", known),
              template_or_none(entry, "robot", known),
              template_or_none(entry, "x", known),
              template_or_none(entry, "y", known),
              entry.number_or("ahead_m", 0),
              entry.number_or("left_m", 0)};
  const int ways = !place.object.empty() + !place.robot.empty() + (!place.x.empty() || !place.y.empty());
  if (ways != 1 || place.x.empty() != place.y.empty())
    entry.fail("a place is either 'object', or 'robot', or 'x' and 'y'");
  if (place.robot.empty() && (place.ahead_m != 0 || place.left_m != 0))
    entry.fail("'ahead_m' and 'left_m' are of a robot; name it by 'robot'");
  return place;
}

std::map<std::string, Range> read_ranges(const Entry& entry) {
  std::map<std::string, Range> ranges;
  entry.each_field([&](const std::string& name, const Entry& value) {
    value.allow_only({"at_least", "at_most"});
    Range range;
    range.least = value.number_or("at_least", range.least);
    range.most = value.number_or("at_most", range.most);
    if (range.least > range.most) value.fail("'at_least' must not be above 'at_most'");
    ranges[name] = range;
  });
  return ranges;
}

CommandCall read_command(const Entry& entry, const Known& known) {
  entry.allow_only({"owner", "robot", "subsystem", "name", "arguments"});
  CommandCall call{entry.at("owner").text(), template_or_none(entry, "robot", known),
                   entry.at("subsystem").text(), entry.at("name").text()};
  if (const auto arguments = entry.find("arguments"))
    arguments->each_field([&](const std::string& name, const Entry& value) {
      call.arguments[name] = read_template(value, known);
    });
  return call;
}

ObserveCall read_observe(const Entry& entry, const Known& known) {
  entry.allow_only({"timeline", "is"});
  ObserveCall call{read_template(entry.at("timeline"), known)};
  if (const auto is = entry.find("is")) {
    const auto items = is->items();
    if (items.empty()) is->fail("'is' must name a state: [state, argument, …]");
    call.state = read_template(items.front(), known);
    for (auto item = items.begin() + 1; item != items.end(); ++item)
      call.arguments.push_back(read_template(*item, known));
  }
  return call;
}

temporal::Duration read_time(const Entry& entry, const std::string& name) {
  const double seconds = entry.number();
  if (seconds <= 0 || seconds > kLongestWait) entry.fail("'" + name + "' must be a positive time in seconds");
  return temporal::seconds(seconds);
}

PathCall read_path(const Entry& entry, const Known& known) {
  entry.allow_only({"planner", "from", "to", "short_m", "map_within_s", "merged"});
  PathCall call{entry.at("planner").text(), read_place(entry.at("from"), known),
                read_place(entry.at("to"), known),
                mission::bounded_number(entry.find("short_m"), "short_m", 0, 0, kLongestCut)};
  const auto within = entry.find("map_within_s"), merged = entry.find("merged");
  if (!within && !merged) return call;
  if (!within || !merged)
    (within ? *within : *merged)
        .fail("'map_within_s' and 'merged', the call that merged the other's map, stand together");
  if (!known.calls.contains(merged->text()))
    merged->fail("'" + merged->text() + "' names no call that has ended by then");
  call.map_told_s = "{" + merged->text() + ".told_s}";
  call.map_within = read_time(*within, "map_within_s");
  return call;
}

Call read_call(const Entry& entry, const Known& known) {
  entry.allow_only({"name", "command", "path", "transform", "observe", "wait_s", "within_s", "check"});
  Call call;
  call.name = entry.at("name").text();
  if (call.name.empty() || call.name.find_first_of(".{}") != std::string::npos)
    entry.at("name").fail("'" + call.name + "' is no name of a call; use letters, digits, '_' and '-'");
  int kinds = 0;
  if (const auto command = entry.find("command")) ++kinds, call.what = read_command(*command, known);
  if (const auto path = entry.find("path")) ++kinds, call.what = read_path(*path, known);
  if (const auto transform = entry.find("transform")) {
    transform->allow_only({"place", "robot"});
    ++kinds, call.what = TransformCall{read_place(transform->at("place"), known),
                                       read_template(transform->at("robot"), known)};
  }
  if (const auto observe = entry.find("observe")) ++kinds, call.what = read_observe(*observe, known);
  if (const auto wait = entry.find("wait_s")) ++kinds, call.what = WaitCall{read_time(*wait, "wait_s")};
  if (kinds != 1) entry.fail("a call has one of 'command', 'path', 'transform', 'observe' and 'wait_s'");
  if (const auto within = entry.find("within_s")) call.within = read_time(*within, "within_s");
  if (const auto check = entry.find("check")) call.check = read_ranges(*check);
  return call;
}

// Adds the names of the calls to what is known after them.
std::vector<Call> read_calls(const Entry& entry, Known& known, std::set<std::string>& names) {
  std::vector<Call> calls;
  for (const Entry& item : entry.items()) {
    calls.push_back(read_call(item, known));
    if (!names.insert(calls.back().name).second)
      item.at("name").fail("call '" + calls.back().name + "' stands twice in this method; names are unique");
    if (names.size() > kCalls) item.fail("a method has at most " + std::to_string(kCalls) + " calls");
    known.calls.insert(calls.back().name);
  }
  if (calls.empty()) entry.fail("there must be a call");
  return calls;
}

Shown read_shown(const Entry& entry, const Known& known) {
  const auto items = entry.items();
  if (items.empty()) entry.fail("a state is written as [name, argument, …]");
  Shown shown{items.front().text(), {}};
  for (auto item = items.begin() + 1; item != items.end(); ++item)
    shown.arguments.push_back(read_template(*item, known));
  return shown;
}

Repair read_repair(const Entry& entry, const Method& method, Known known, std::set<std::string>& names) {
  entry.allow_only({"calls", "then", "at_most", "needs", "shows"});
  Repair repair;
  if (const auto shows = entry.find("shows")) repair.shows = read_shown(*shows, known);
  repair.calls = read_calls(entry.at("calls"), known, names);
  if (const auto then = entry.find("then")) {
    const std::string target = then->text();
    const bool is_call = std::ranges::find(method.calls, target, &Call::name) != method.calls.end();
    repair.ends = target == kEnd;
    if (repair.ends && is_call)
      then->fail("'end' ends the method, which has a call of that name, too; give the call another name");
    if (!repair.ends && !is_call)
      then->fail("the method has no call '" + target + "' to go on with; 'end' ends the method");
    if (!repair.ends) repair.then = target;
  }
  if (const auto most = entry.find("at_most")) {
    if (most->integer() < 1 || most->integer() > 1000) most->fail("'at_most' must be from 1 to 1000");
    repair.at_most = static_cast<std::uint32_t>(most->integer());
  }
  if (const auto needs = entry.find("needs")) repair.needs = read_ranges(*needs);
  return repair;
}

// A repair that ends the method leaves out the calls from the one that failed on: no result may come from them.
void check_brought_before(const Method& method, const std::string& error, const std::string& result,
                          const Entry& entry) {
  const auto position = [&](const std::string& name) {
    return std::ranges::find(method.calls, name.substr(0, name.find('.')), &Call::name) -
           method.calls.begin();
  };
  const bool of_one_call = error.find('.') != std::string::npos;
  if (of_one_call && position(method.results.at(result)) < position(error)) return;
  entry.fail("the repair of '" + error +
             "' ends the method, maybe before a call has brought this; let it go on with " +
             "a call of the method ('then'), or leave the result out");
}

Method read_method(const std::string& command, const Entry& entry) {
  entry.allow_only({"arguments", "calls", "repairs", "results", "during", "then", "failed", "tells"});
  Method method;
  method.command = command;
  if (const auto arguments = entry.find("arguments")) method.arguments = arguments->texts();
  Known known{{method.arguments.begin(), method.arguments.end()}, {}};
  if (const auto during = entry.find("during")) method.during = read_shown(*during, known);
  if (const auto failed = entry.find("failed"))
    failed->each_field([&](const std::string& error, const Entry& value) {
      method.failed[error] = read_shown(value, known);
    });
  if (const auto tells = entry.find("tells"))
    tells->each_field([&](const std::string& outcome, const Entry& value) {
      value.each_field([&](const std::string& timeline, const Entry& state) {
        if (const auto names = names_in(timeline);
            !names ||
            !std::ranges::all_of(*names, [&](const auto& name) { return known.arguments.contains(name); }))
          state.fail("the timeline '" + timeline +
                     "' may hold arguments of the command in braces, and nothing else");
        method.tells[outcome][timeline] = read_shown(state, known);
      });
    });
  std::set<std::string> names;
  method.calls = read_calls(entry.at("calls"), known, names);
  if (const auto repairs = entry.find("repairs"))
    repairs->each_field([&](const std::string& error, const Entry& value) {
      const std::string call = error.substr(0, error.find('.'));
      if (call != error &&
          std::ranges::none_of(method.calls, [&](const Call& one) { return one.name == call; }))
        value.fail("the method has no call '" + call + "' whose error this could repair");
      method.repairs[error] = read_repair(value, method, known, names);
    });
  if (const auto then = entry.find("then")) method.then = read_shown(*then, known);
  if (const auto results = entry.find("results"))
    results->each_field([&](const std::string& name, const Entry& value) {
      const std::string text = read_template(value, known);
      if (names_in(text)->size() != 1 || text.front() != '{' || text.back() != '}' ||
          text.find('.') == std::string::npos)
        value.fail("a result is one value of one call: \"{call.value}\"");
      method.results[name] = text.substr(1, text.size() - 2);
      for (const auto& [error, repair] : method.repairs)
        if (repair.ends) check_brought_before(method, error, name, value);
    });
  return method;
}

}  // namespace

Methods read_methods(const Entry& section) {
  section.allow_only({"timeline", "subsystem", "rest", "methods"});
  Methods out;
  out.timeline = section.at("timeline").text();
  out.subsystem = section.at("subsystem").text();
  if (const auto rest = section.find("rest")) out.rest = read_shown(*rest, {});
  const Entry list = section.at("methods");
  list.each_field([&](const std::string& command, const Entry& entry) {
    if (command == "stop") entry.fail("'stop' is understood by every owner; give the method another name");
    out.methods[command] = read_method(command, entry);
    if (out.methods.size() > kMethods)
      entry.fail("there are at most " + std::to_string(kMethods) + " methods");
  });
  if (out.methods.empty()) list.fail("there must be a method");
  return out;
}

}  // namespace roci::dedicated::methods
