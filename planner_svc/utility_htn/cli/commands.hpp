// These are the commands of roci-network, apart from its command line.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace roci::planner::utility_htn::cli {

/// Names the exit codes (docs/exit-codes.md).
enum ExitCode { done = 0, faulty = 1, wrong_use = 2 };

/// Takes what people and what programs read.
struct Output {
  std::ostream& out;
  std::ostream& errors;
  bool json = false;
};

/// Prints all that is wrong with a network, each fault with its place and remedy,
/// or in one line what the network holds.
ExitCode check(const std::filesystem::path& file, const Output& output);

/// Prints every chain with its utility, what it takes from the budget, and its duration.
ExitCode chains(const std::filesystem::path& file, const Output& output);

/// Prints the plan that the planner would begin with, and why what is not in it is not; of the tasks that are named
/// every way, of all others the way that is worth most. `changes` are NAME=VALUE, a parameter or a timeline's first
/// value. A wrong name or value ends with wrong_use.
ExitCode explain(const std::filesystem::path& file, const std::vector<std::string>& tasks,
                 const std::vector<std::string>& changes, const Output& output);

/// Writes the binary form of a network, which may be in either form, to a file.
ExitCode pack(const std::filesystem::path& file, const std::filesystem::path& to, const Output& output);

/// Writes a network as YAML, in full, to a file, or where `to` is empty to standard output.
ExitCode unpack(const std::filesystem::path& file, const std::filesystem::path& to, const Output& output);

}  // namespace roci::planner::utility_htn::cli
