#include "dedicated_svc/methods/methods_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dedicated_svc/methods/fill.hpp"

namespace roci::dedicated::methods {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Reads one method `go` with these lines, each indented by six more.
std::string fault(const std::string& method,
                  const std::string& head = "timeline: r.loco\n  subsystem: loco\n") {
  const std::string text = "dedicated:\n  " + head + "  methods:\n    go:\n" + method;
  try {
    read_methods(mission::Entry::parse(text, "mission.yaml").at("dedicated"));
  } catch (const mission::FileError& error) {
    return error.what();
  }
  return "";
}

constexpr char kCall[] = "{name: a, command: {owner: o, subsystem: s, name: c}}";

TEST(MethodsFile, ReadsACallOfEachKind) {
  EXPECT_EQ(
      fault("      arguments: [wp]\n      calls:\n"
            "        - {name: a, command: {owner: o, subsystem: s, name: c, arguments: {to: \"{wp}\"}}}\n"
            "        - {name: b, path: {planner: p, from: {robot: r}, to: {object: \"{wp}\"}}, within_s: 3}\n"
            "        - {name: c, transform: {place: {x: \"{b.next_x}\", y: \"1\"}, robot: r}}\n"
            "        - {name: d, observe: {timeline: r.nav, is: [idle-at, \"{wp}\"]}}\n"),
      "");
}

TEST(MethodsFile, RefusesWhatCannotBeMeant) {
  const std::pair<std::string, std::string> cases[] = {
      {"      calls: []\n", "mission.yaml:6:14: there must be a call"},
      {"      calls: [{name: a}]\n", "one of 'command', 'path', 'transform', 'observe' and 'wait_s'"},
      {"      calls: [{name: a, observe: {timeline: t}, path: {planner: p, from: {robot: r}, to: {robot: "
       "r}}}]\n",
       "one of 'command'"},
      {"      calls: [" + std::string(kCall) + ", " + kCall + "]\n", "call 'a' stands twice"},
      {"      calls: [{name: a, observe: {timeline: \"{wp}\"}}]\n", "'{wp}' is no argument of this command"},
      {"      calls: [{name: a, observe: {timeline: \"{b.x}\"}}, {name: b, observe: {timeline: t}}]\n",
       "names no call that has ended by then"},
      {"      calls: [{name: a, observe: {timeline: \"{wp\"}}]\n", "braces that do not match"},
      {"      calls: [{name: a.b, observe: {timeline: t}}]\n", "is no name of a call"},
      {"      calls: [{name: a, observe: {timeline: t}, within_s: -1}]\n",
       "'within_s' must be a positive time"},
      {"      calls: [{name: a, observe: {timeline: t}, check: {v: {at_least: 2, at_most: 1}}}]\n",
       "'at_least' must not be above"},
      {"      calls: [{name: a, transform: {place: {x: \"1\"}, robot: r}}]\n", "either 'object', or 'robot'"},
      {"      calls: [{name: a, transform: {place: {x: \"1\", y: \"2\", ahead_m: 3}, robot: r}}]\n",
       "'ahead_m' and 'left_m' are of a robot"},
      {"      calls: [{name: a, observe: {timeline: t, whithin_s: 3}}]\n", "whithin_s"},
      {"      calls: [" + std::string(kCall) + "]\n      repairs: {e: {calls: [" + kCall + "]}}\n",
       "stands twice"},
      {"      calls: [" + std::string(kCall) +
           "]\n      repairs: {e: {calls: [{name: b, observe: {timeline: t}}], then: z}}\n",
       "the method has no call 'z' to go on with; 'end' ends the method"},
      {"      calls: [{name: end, wait_s: 1}]\n"
       "      repairs: {e: {calls: [{name: b, wait_s: 1}], then: end}}\n",
       "mission.yaml:7:58: 'end' ends the method, which has a call of that name, too"},
      {"      calls: [{name: a, wait_s: 1}, {name: b, wait_s: 1}]\n"
       "      repairs: {b.e: {calls: [{name: c, wait_s: 1}], then: end}}\n"
       "      results: {x: \"{b.y}\"}\n",
       "mission.yaml:8:20: the repair of 'b.e' ends the method"},
      {"      calls: [{name: a, wait_s: 1}, {name: b, wait_s: 1}]\n"
       "      repairs: {e: {calls: [{name: c, wait_s: 1}], then: end}}\n"
       "      results: {x: \"{a.y}\"}\n",
       "the repair of 'e' ends the method"},
      {"      calls: [" + std::string(kCall) +
           "]\n      repairs: {e: {calls: [{name: b, observe: {timeline: t}}], at_most: 0}}\n",
       "'at_most' must be from 1 to"},
      {"      calls: [" + std::string(kCall) + "]\n      repairs: {z.e: {calls: [{name: b, wait_s: 1}]}}\n",
       "the method has no call 'z' whose error"},
      {"      calls: [{name: a, path: {planner: p, from: {robot: r}, to: {robot: r}, short_m: -1}}]\n",
       "mission.yaml:6:87: 'short_m' must lie between 0"},
      {"      calls: [{name: a, path: {planner: p, from: {robot: r}, to: {robot: r}, short_m: 1e9}}]\n",
       "'short_m' must lie between 0"},
      {"      calls: [{name: a, path: {planner: p, from: {robot: r}, to: {robot: r}, map_within_s: 9}}]\n",
       "mission.yaml:6:92: 'map_within_s' and 'merged'"},
      {"      calls: [{name: a, path: {planner: p, from: {robot: r}, to: {robot: r}, map_within_s: 9, "
       "merged: "
       "b}}]\n",
       "'b' names no call that has ended by then"},
      {"      calls: [{name: b, wait_s: 1}, {name: a, path: {planner: p, from: {robot: r}, to: {robot: r}, "
       "map_within_s: 0, merged: b}}]\n",
       "'map_within_s' must be a positive time"},
      {"      calls: [{name: a, wait_s: 0}]\n", "'wait_s' must be a positive time"},
      {"      calls: [" + std::string(kCall) + "]\n      results: {x: \"2\"}\n", "one value of one call"},
      {"      calls: [" + std::string(kCall) + "]\n      then: []\n", "a state is written as"},
  };
  for (const auto& [method, words] : cases) EXPECT_THAT(fault(method), HasSubstr(words)) << method;
  EXPECT_THAT(fault("      calls: [" + std::string(kCall) + "]\n", "subsystem: loco\n"),
              HasSubstr("timeline"));
}

TEST(MethodsFile, ARepairMayEndTheMethodWhereItsResultsAreThere) {
  EXPECT_EQ(fault("      calls: [{name: a, wait_s: 1}, {name: b, wait_s: 1}]\n"
                  "      repairs: {b.e: {calls: [{name: c, wait_s: 1}], then: end}}\n"
                  "      results: {x: \"{a.y}\"}\n"),
            "");
  EXPECT_EQ(fault("      calls: [{name: end, wait_s: 1}, {name: b, wait_s: 1}]\n"), "")
      << "a call may have the name where no repair does";
}

TEST(MethodsFile, AMethodIsNotCalledStop) {
  const std::string text =
      "dedicated: {timeline: t, subsystem: s, methods: {stop: {calls: [" + std::string(kCall) + "]}}}";
  EXPECT_THROW(read_methods(mission::Entry::parse(text, "m").at("dedicated")), mission::FileError);
}

TEST(Fill, PutsInWhatIsNamed) {
  EXPECT_THAT(*names_in("a{b}c{d.e}"), ElementsAre("b", "d.e"));
  for (const char* bad : {"{", "}", "{}", "{a{b}}", "a}b{"}) EXPECT_FALSE(names_in(bad)) << bad;
  const auto value_of = [](const std::string& name) {
    return name == "b" ? std::optional<std::string>("{x}") : std::nullopt;
  };
  EXPECT_EQ(fill("a{b}c", value_of), "a{x}c") << "a value is no template";
  EXPECT_EQ(fill("a{z}c", value_of), std::nullopt);
}

}  // namespace
}  // namespace roci::dedicated::methods
