// The command line of roci-plan: what can be asked of it.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <string>

namespace roci::planner::temporal_pddl::cli {

/// Returns how many MiB roci-plan takes at most if nothing is said: 4096, or three quarters of a smaller machine's
/// memory; 0, which is no limit, in a build with a sanitizer, whose shadow memory is more than any limit.
std::size_t default_megabytes();

/// Holds what the command line asks for; a limit of 0 is none.
struct Arguments {
  std::string domain, problem, functions, stats, remaining, gantt;
  std::string functions_mode = "eager";
  double seconds = 0;            ///< of wall time
  double processor_seconds = 0;  ///< of processor time
  std::size_t megabytes = default_megabytes();
  std::size_t evaluations = 0;
  std::size_t improve = 0;  ///< evaluations
  std::uint64_t seed = 0;
  bool strict = false;
  bool parse_only = false;
  bool json = false;
  bool plain_search = false;
  bool progress = false;
};

/// Adds every option, with its help. `arguments` must outlive the app's parsing.
void add_options(CLI::App& app, Arguments& arguments);

}  // namespace roci::planner::temporal_pddl::cli
