// A dry plan tells whether each goal kind of a mission can be planned at all, from where its scenarios begin.
#pragma once

#include <string>
#include <vector>

#include "rehearsal/check/asked_owners.hpp"
#include "rehearsal/check/checked_mission.hpp"

namespace roci::rehearsal::check {

/// A goal kind for which a plan was made.
struct PlannedKind {
  std::string kind;
  std::string scenario;
  std::string goal;  ///< id
  std::size_t activities = 0;
};

/// A goal kind that was not tried, and why.
struct UnplannedKind {
  std::string kind;
  std::string why;
};

/// A goal kind of which no goal that was tried can be achieved: a finding says why in words of the mission, and this
/// what the planner itself said.
struct UnachievedKind {
  std::string kind;
  std::string scenario;
  std::string goal;  ///< id
  std::string verdict;
  std::string details;
};

/// Holds which goal kinds were planned, which have no plan, and which were not tried.
struct DryPlans {
  std::vector<PlannedKind> planned;
  std::vector<UnachievedKind> unachieved;
  std::vector<UnplannedKind> not_tried;
};

/// Plans one goal of each kind (those that it names with it), with the mission's engine and budget, from the first
/// observations of the simulated world; of the scenarios' goals of a kind the first few, until one is planned. Their
/// windows do not count. A component that is not simulated is taken to be in its first inactive state. A
/// kind of which none can be planned is a finding at its entry in the mission file, in the words of the mission: the
/// goal with its arguments, and which owner of a function said what. Goal kinds of missions whose
/// engine or world is not linked here, or where such a component's first state has arguments, are not tried.
DryPlans dry_plan(const CheckedMission& mission, const CheckedExecutive& executive, AskedOwners& owners,
                  mission::Findings& findings);

/// Notes what is wrong with the model of an engine whose models come with each request, which no service would read
/// before the first one, and keeps in `executive` of which timelines its plans tell.
void check_engine_model(CheckedExecutive& executive, mission::Findings& findings);

/// Finds modules and external functions of the domain, or of a model in the engine's own language, that no service of
/// the mission offers. Where programs of the mission's own could offer them, only names that are nearly an offered one
/// are findings.
void check_functions(const CheckedMission& mission, const CheckedExecutive& executive, AskedOwners& owners,
                     mission::Findings& findings);

}  // namespace roci::rehearsal::check
