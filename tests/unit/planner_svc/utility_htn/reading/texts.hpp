// A network file in which each kind of thing stands once.
#pragma once

#include <string>

#include "planner_svc/utility_htn/reading/load.hpp"
#include "planner_svc/utility_htn/reading/yaml.hpp"

namespace roci::planner::utility_htn::reading {

inline const std::string kSound = R"(format: 1
network: lander
version: 3
ranks: [mission, analysis]
batches: [outside, sampling]
budget: battery
cycle: {process_interval_s: 10, worst_cycle_s: 2, commit_window_s: 20}
constants: {capacity_j: {value: 50 * 3600, source: "a study"}}
sets: {sites: [0, 1]}
parameters:
  dig_s_{site}:
    for: {site: sites}
    value: 100
    range: [10, 1000]
    source: chosen
timelines:
  battery: {kind: cumulative_rate, initial: "{capacity_j}", range: [0, "{capacity_j}"]}
  phase: {kind: state, states: [landed, sampling, done], initial: sampling, reported: false}
  arm: {kind: atomic}
templates:
  dig_{site}:
    for: {site: sites}
    name: Dig({site})
    command: {owner: sim_svc, component: arm, command: dig, arguments: {site: "{site}"}, answer_within_s: 5}
    duration_s: "2 * dig_s_{site} + 5"
    pre: ["phase != landed", "battery >= 500"]
    maintenance: "battery in 10 .. 20000"
    impacts:
      battery: [{rate: -3}, {add: -7, at: start}]
      arm: {take: 1}
      phase: {set: done}
    control: {wait_s: 60, retries: 2, may_skip: true, skip_if: "phase = done"}
    on_failure: {respond: {owner: sim_svc, command: stop}, request: stow, withdraw: hotel_load}
    utility: {analysis: 0.5}
    products: {images: {tier: decisional, bytes: 1e6, utility: {analysis: 0.25}}}
    learns: {duration_s: "dig_s_{site}", values: {"yield_{site}": "dig_s_{site}"}}
  stow: {duration_s: 10}
tasks:
  hotel_load: {batch: outside, fixed: true, start_s: 0, duration_s: 1000, impacts: {battery: {rate: -1}}}
  site_{site}:
    for: {site: sites}
    batch: sampling
    priority: 4
    decompositions:
      first: {when: "phase = sampling", sequence: [{task: "dig_{site}"}, {task: stow, after_s: 1, within_s: 60}]}
      again: ["dig_{site}"]
  uplink_{n}:
    for: [{n: 1, hour: 2}, {n: 2, hour: 14}]
    batch: outside
    fixed: true
    start_s: "{hour} * 3600"
)";

/// Returns all that is found in a text, one finding in each line, with its remedy.
inline std::string faults_of(const std::string& text) {
  mission::Findings findings;
  const Read read = parse_yaml(text, "n.yaml", findings);
  std::string out;
  for (const auto& finding : findings.sorted()) out += finding.text() + "; " + finding.remedy + "\n";
  return out;
}

/// Returns the text with the first `from` replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? "not found: " + from : text.replace(at, from.size(), to);
}

}  // namespace roci::planner::utility_htn::reading
