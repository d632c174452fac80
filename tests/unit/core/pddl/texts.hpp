// Short domains for the tests of core/pddl.
#pragma once

#include <string>

#include "core/pddl/parser.hpp"

namespace roci::pddl {

// A domain with the usual declarations and `sections` after them. Objects are of type thing or its subtype
// tool.
inline std::string domain_text(const std::string& sections) {
  return "(define (domain d)\n"
         "(:types tool - thing thing place)\n"
         "(:constants hammer - tool base - place)\n"
         "(:predicates (p) (q ?x - thing) (r ?x - thing ?y - place) (s ?x - thing))\n"
         "(:functions (f) (g ?x - thing))\n"
         "(:modules (:module m (:function (cost ?x - thing ?y - place))))\n" +
         sections + ")\n";
}

inline Domain domain_with(const std::string& sections) {
  return parse_domain(domain_text(sections), "d.pddl");
}

inline Action action_with(const std::string& fields) {
  return domain_with("(:action a :parameters (?t - thing ?l - place) " + fields + ")").actions.front();
}

inline Condition condition_of(const std::string& text) {
  return action_with(":precondition " + text).precondition;
}

inline DurativeAction durative_with(const std::string& fields) {
  return domain_with("(:durative-action a :parameters (?t - thing ?l - place) " + fields + ")")
      .durative_actions.front();
}

inline std::string problem_text(const std::string& init, const std::string& goal = "(p)") {
  return "(define (problem x) (:domain d)\n(:objects nail - thing pit - place)\n(:init " + init +
         ")\n(:goal " + goal + "))\n";
}

inline Problem problem_with(const std::string& init, const std::string& goal = "(p)") {
  return parse_problem(problem_text(init, goal), "x.pddl");
}

}  // namespace roci::pddl
