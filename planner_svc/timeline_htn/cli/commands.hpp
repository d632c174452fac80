// These are the commands of roci-timelines, apart from its command line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "planner_svc/timeline_htn/search/resolvers.hpp"

namespace roci::planner::timeline_htn::cli {

/// Names the exit codes (docs/exit-codes.md).
enum ExitCode { done = 0, faulty = 1, wrong_use = 2, unsolved = 3, out_of_memory = 5, no_functions = 6 };

/// Takes what people and what programs read.
struct Output {
  std::ostream& out;
  std::ostream& errors;
  bool json = false;
};

using Files = std::vector<std::filesystem::path>;

inline constexpr std::size_t kDefaultMegabytes = 1024;

/// Holds the options of a planning run.
struct PlanOptions {
  std::vector<search::Resolver> resolvers{search::Resolver{}};  ///< that search side by side
  std::size_t threads = 1;
  std::uint64_t work = 10'000'000;            ///< steps of the search
  std::size_t megabytes = kDefaultMegabytes;  ///< that the searches keep together; 0: no bound
  std::filesystem::path functions;            ///< values of external functions; empty: there are none
};

/// Prints all that is wrong with a model, each fault with its place and remedy, or in one line what it holds.
ExitCode check(const Files& files, const Output& output);

/// Plans and prints the plan: every level as a tree, times, decisions; with `json` as one object.
ExitCode plan(const Files& files, const PlanOptions& options, const Output& output);

/// Plans and prints the matrix: `form` is text, json or svg.
ExitCode matrix(const Files& files, const PlanOptions& options, const std::string& form,
                const Output& output);

}  // namespace roci::planner::timeline_htn::cli
