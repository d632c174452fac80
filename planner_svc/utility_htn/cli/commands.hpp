// What roci-network does with a task network, apart from its command line.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace roci::planner::utility_htn::cli {

/// Are the exit codes (docs/exit-codes.md).
enum ExitCode { done = 0, faulty = 1, wrong_use = 2 };

/// Takes what people and what programs read.
struct Output {
  std::ostream& out;
  std::ostream& errors;
  bool json = false;
};

/// Prints all that is wrong with a network, each fault with its place and remedy, or in one line what the network holds.
ExitCode check(const std::filesystem::path& file, const Output& output);

/// Prints every chain with its utility, what it takes from the budget, and its duration.
ExitCode chains(const std::filesystem::path& file, const Output& output);

/// Writes the binary form of a network, which may be in either form, to a file.
ExitCode pack(const std::filesystem::path& file, const std::filesystem::path& to, const Output& output);

/// Writes a network as YAML, in full, to a file, or where `to` is empty to standard output.
ExitCode unpack(const std::filesystem::path& file, const std::filesystem::path& to, const Output& output);

}  // namespace roci::planner::utility_htn::cli
