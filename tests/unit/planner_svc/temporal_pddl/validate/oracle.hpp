// A second opinion on plans: propositional problems with one number, so small that PDDL's definitions can be
// executed on bit sets, millisecond by millisecond. Shares no code with the validator.
#pragma once

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace roci::planner::temporal_pddl::validate {

inline constexpr int kFacts = 4;
using FactSet = std::uint32_t;  // bit i: fact (fi)

struct Clause {  // some of `yes` is true or some of `no` is false
  FactSet yes = 0;
  FactSet no = 0;
};

enum class NumberEffect { none, increase, assign };  // on the number x

// What one end of an action asks for and does.
struct SnapAction {
  std::vector<Clause> conditions;
  bool needs_number = false;  // x >= 0
  FactSet adds = 0;
  FactSet deletes = 0;
  FactSet trigger = 0;         // at most one fact: if it is true …
  FactSet triggered_adds = 0;  // … these are added
  NumberEffect number = NumberEffect::none;
  int operand = 0;
};

struct SmallAction {
  bool durative = false;
  int least = 0;  // duration, milliseconds
  int most = 0;
  SnapAction start;  // or the whole of an instantaneous action
  std::vector<Clause> over_all;
  SnapAction end;
};

struct SmallTimedFact {
  int time = 0;
  int fact = 0;
  bool value = false;
};

struct SmallStep {
  int start = 0;
  int action = 0;
  int duration = 0;
};

struct SmallCase {
  std::vector<SmallAction> actions;
  FactSet initial = 0;
  std::vector<SmallTimedFact> timed_facts;
  std::vector<Clause> goal;
  std::vector<SmallStep> plan;
};

SmallCase random_case(std::mt19937_64& random);

// The case as PDDL.
std::string domain_sections(const SmallCase& small);
std::string problem_sections(const SmallCase& small);
std::string plan_text(const SmallCase& small);

// What follows an interference depends on an order that nobody defines; so does what the caller may compare.
// All violations as "kind@time", as kinds() in checking.hpp names them, without repetition.
std::set<std::string> judge(const SmallCase& small, int epsilon);

}  // namespace roci::planner::temporal_pddl::validate
