// roci-network: roci-network check|chains|explain|pack|unpack|cycle FILE …
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/cli/commands.hpp"
#include "planner_svc/utility_htn/cli/cycle.hpp"

namespace roci::planner::utility_htn::cli {
namespace {

int run_command_line(int argc, char** argv) {
  CLI::App app(
      "Checks and shows the task networks of utility-driven missions, turns them into their binary form and "
      "back, and plans again what was flown with them");
  app.require_subcommand(1);
  app.footer(
      "What a network holds and how it is written: docs/network-format.md. Exit codes: 0 done, 1 the network "
      "has errors, a cycle is not as it was flown or a schedule of downlinks is wrong, 2 wrong use.");
  std::string file, to;
  bool json = false;
  const auto command = [&](const char* name, const char* help) {
    CLI::App* out = app.add_subcommand(name, help);
    out->add_option("FILE", file, "a network, as YAML or in binary form")->required();
    return out;
  };
  CLI::App* check_command = command("check", "Tells all that is wrong with it, with file, line and remedy");
  check_command->add_flag("--json", json, "as one JSON object");
  CLI::App* chains_command =
      command("chains", "Lists every way to do its tasks, with utility, cost and duration");
  chains_command->add_flag("--json", json, "as one JSON object");
  std::vector<std::string> tasks, changes;
  CLI::App* explain_command =
      command("explain", "Plans it from its beginning, and says why what is not planned is not");
  explain_command->add_option("TASK", tasks, "of these every way to do them is explained, and of no other");
  explain_command
      ->add_option("--set", changes, "NAME=VALUE: a parameter, or a timeline's first value, is that")
      ->allow_extra_args(false);
  explain_command->add_flag("--json", json, "as one JSON object");
  CLI::App* pack_command = command("pack", "Writes its binary form, which is what the lander takes");
  pack_command->add_option("-o,--output", to, "the file to write")->required();
  CLI::App* unpack_command = command("unpack", "Writes it as YAML, in full");
  unpack_command->add_option("-o,--output", to, "the file to write; without it standard output");
  std::uint64_t until = 0;
  CLI::App* cycle_command = app.add_subcommand(
      "cycle", "Plans the cycles of a flight again, alone, from the record of what its planner heard; checks downlinks");
  cycle_command->add_option("RECORD", file, "planner_steps/N.steps of a run folder")->required();
  cycle_command->add_option("--until", until,
                            "the last cycle to plan again, of those that are counted from 1");
  cycle_command->add_flag("--json", json, "as one JSON object");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : wrong_use;
  }
  const Output output{std::cout, std::cerr, json};
  if (*check_command) return check(file, output);
  if (*chains_command) return chains(file, output);
  if (*explain_command) return explain(file, tasks, changes, output);
  if (*cycle_command) return cycle(file, until, output);
  if (*pack_command) return pack(file, to, output);
  return unpack(file, to, output);
}

}  // namespace
}  // namespace roci::planner::utility_htn::cli

int main(int argc, char** argv) { return roci::planner::utility_htn::cli::run_command_line(argc, argv); }
