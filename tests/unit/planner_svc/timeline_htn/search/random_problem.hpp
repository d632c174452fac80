// Texts of small random problems without parameters, for comparisons with brute force.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace roci::planner::timeline_htn::search {

/// Makes the text of a problem: two primitive components of two or three states, an abstract one with two complex
/// states, one or two behaviours for each, one or two goals. Asked for, behaviours have conditions.
class RandomProblem {
 public:
  explicit RandomProblem(std::uint64_t seed, bool with_conditions = false)
      : random_(seed), with_conditions_(with_conditions) {}
  /// Adds a component whose values are predicted, of which states need some and behaviours ask for some.
  static RandomProblem with_windows(std::uint64_t seed) {
    RandomProblem out(seed);
    out.with_windows_ = true;
    return out;
  }
  /// Goals are states of the primitive components alone, default ones among them, in narrow windows that open late.
  static RandomProblem with_late_goals(std::uint64_t seed) {
    RandomProblem out(seed);
    out.with_late_goals_ = true;
    return out;
  }
  /// Begins in an error, which one of one or two behaviours mends before the goals come; behaviours have conditions,
  /// and states may take no time.
  static RandomProblem with_error(std::uint64_t seed) {
    RandomProblem out(seed, true);
    out.with_error_ = true;
    return out;
  }

  std::string text() {
    const std::string q = component("q", ""), p = component("p", "q");
    const std::string window =
        with_windows_
            ? "  w:\n    layer: primitive\n    states: {in: {kind: default}, out: {kind: default}}\n"
              "    transitions: [in <-> out]\n"
            : "";
    return "domain: random\ncomponents:\n  m:\n    layer: abstract\n    states: {idle: {kind: default}, t: "
           "{kind: complex}, "
           "u: {kind: complex}}\n    transitions: [idle <-> t, idle <-> u]\n" +
           q + p + window + "behaviours:\n" + behaviours() + mending() + problem();
  }

 private:
  int number(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  bool chance(int percent) { return number(1, 100) <= percent; }
  std::string one_of(const std::vector<std::string>& all) {
    return all[static_cast<std::size_t>(number(0, static_cast<int>(all.size()) - 1))];
  }

  std::string component(const std::string& name, const std::string& other) {
    const bool two_rest = chance(50);
    std::vector<std::string>& states = states_[name];
    states = {"a", "b"};
    if (two_rest) states.push_back("r");
    std::string out = "  " + name + ":\n    layer: primitive\n    states:\n      idle: {kind: default}\n";
    if (two_rest) out += "      r: {kind: default}\n";
    const bool begins_in_error = with_error_ && name == "p";
    if (begins_in_error) out += "      e: {kind: error}\n";
    for (const char* simple : {"a", "b"}) {
      const int shortest = number(with_error_ ? 0 : 1, 4);
      out += "      " + std::string(simple) + ": {kind: simple, duration_s: [" + std::to_string(shortest) +
             ", " + std::to_string(shortest + number(0, 4)) + "]";
      std::string needs;
      if (!other.empty() && chance(50))
        needs = one_of({"during", "at_start", "met_by"}) + " " + other + "." + one_of(states_[other]);
      if (with_windows_ && chance(60))
        needs += (needs.empty() ? "" : ", ") + one_of({"during", "during", "at_start", "met_by"}) + " w." +
                 one_of({"in", "in", "out"});
      if (!needs.empty()) out += ", needs: [" + needs + "]";
      out += "}\n";
    }
    std::string transitions = "\"idle -> a\", \"b -> " + one_of({"idle", "a"}) + "\", \"a -> " +
                              one_of({"idle", two_rest ? "r" : "b"}) + "\"";
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"idle", "b"}, {"a", "b"}, {"b", "a"}, {"a", "idle"}, {"b", "idle"}})
      if (chance(50)) transitions += ", \"" + from + " -> " + to + "\"";
    if (two_rest) transitions += ", \"r -> " + one_of({"idle", "a", "b"}) + "\"";
    if (begins_in_error) transitions += ", \"e -> " + one_of({"idle", "idle", "a"}) + "\"";
    states.push_back("idle");
    return out + "    transitions: [" + transitions + "]\n";
  }

  std::string subgoal() {
    const std::string component = one_of({"p", "q"});
    return component + "." + one_of(states_[component]);
  }

  std::string behaviours() {
    std::string out;
    int index = 0;
    for (const char* state : {"t", "u"}) {
      for (int b = number(1, 2); b > 0; --b) {
        const int count = number(1, 3);
        out += "  b" + std::to_string(index++) + ":\n    achieves: m." + state + "\n    subgoals: {";
        for (int s = 0; s < count; ++s) out += (s == 0 ? "g" : ", g") + std::to_string(s) + ": " + subgoal();
        out += "}\n";
        if (with_conditions_ && chance(60))
          out += "    conditions: [" + std::string(chance(30) ? "not " : "") + subgoal() + "]\n";
        if (with_windows_ && chance(40))
          out +=
              "    conditions: [" + std::string(chance(30) ? "not " : "") + one_of({"w.in", "w.out"}) + "]\n";
        out += "    constraints:\n";
        for (int c = 0; c < count - 1; ++c) {
          const std::string from = "g" + std::to_string(c), to = "g" + std::to_string(c + 1);
          const int low = number(0, 3);
          out += "      - \"" +
                 one_of({from + " before " + to,
                         to + " before " + from + " [" + std::to_string(low) + ", " +
                             std::to_string(low + number(0, 4)) + "]",
                         from + " during " + to, from + " starts " + to, from + " meets " + to,
                         from + ".start to " + to + ".start [0, " + std::to_string(number(1, 6)) + "]"}) +
                 "\"\n";
        }
        if (chance(30))
          out += "      - \"self.start to self.end [0, " + std::to_string(number(3, 10)) + "]\"\n";
        if (count == 1) out += "      - \"g0 during self\"\n";
      }
    }
    return out;
  }

  // What mends the error of p.
  std::string mending() {
    std::string out;
    for (int b = with_error_ ? number(1, 2) : 0; b > 0; --b) {
      const int count = number(1, 3);
      out += "  mend" + std::to_string(b) + ":\n    triggers: [p.e]\n    subgoals: {";
      for (int s = 0; s < count; ++s)
        out += (s == 0 ? "g" : ", g") + std::to_string(s) + ": " +
               (chance(30) ? "m." + one_of({"t", "u"}) : subgoal());
      out += "}\n";
      if (count > 1 && chance(70))
        out += std::string("    constraints: [g0 before g1") + (count > 2 ? " before g2]\n" : "]\n");
    }
    return out;
  }

  std::string problem() {
    std::string out = "problem:\n  horizon_s: " + std::to_string(number(8, 24)) +
                      "\n  initial: {m: idle, p: " + (with_error_ ? "e" : "idle") + ", q: idle" + windows() +
                      "}\n  goals:\n";
    const int goals = number(1, 2);
    for (int g = 0; g < goals; ++g) {
      const int opens = with_late_goals_ ? number(4, 16) : number(0, 4);
      out += "    g" + std::to_string(g) +
             ": {state: " + (!with_late_goals_ && chance(70) ? "m." + one_of({"t", "u"}) : subgoal()) +
             ", window_s: [" + std::to_string(opens) + ", " +
             std::to_string(opens + number(0, with_late_goals_ ? 2 : 12)) + "]" +
             (g > 0 && chance(50) ? ", after: [g0]" : "") + "}\n";
    }
    return out;
  }

  // The state in which w begins, and those that are predicted of it.
  std::string windows() {
    if (!with_windows_) return "";
    bool in = chance(50);
    std::string out = std::string(", w: ") + (in ? "in" : "out") + "}\n  predicted: {w: [";
    for (int at = number(1, 6); at < 24 && chance(80); at += number(1, 8)) {
      in = !in;
      out += std::string(out.ends_with('[') ? "" : ", ") + "{at_s: " + std::to_string(at) +
             ", state: " + (in ? "in" : "out") + "}";
    }
    return out + "]";
  }

  std::mt19937_64 random_;
  bool with_conditions_;
  bool with_windows_ = false;
  bool with_late_goals_ = false;
  bool with_error_ = false;
  std::map<std::string, std::vector<std::string>> states_;
};

}  // namespace roci::planner::timeline_htn::search
