// roci: the ground tool. `roci --help` lists the verbs.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/mission/entry.hpp"
#include "ground_console/cli/map/map.hpp"
#include "ground_console/cli/mission_words.hpp"
#include "ground_console/cli/network.hpp"
#include "ground_console/cli/orders.hpp"
#include "ground_console/cli/outlook/verb.hpp"
#include "ground_console/cli/reach.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/runs.hpp"
#include "ground_console/cli/unknown_verb.hpp"
#include "ground_console/cli/verbs.hpp"
#include "ground_console/cli/watch/watch.hpp"
#include "services/process/mission_folder.hpp"

namespace {

namespace cli = roci::console::cli;
namespace lib = roci::console::lib;

struct Line {
  roci::services::process::ConnectionFlags connection;
  std::string executive;
  bool json = false;
  bool waits = false;  // for a mission to run
  cli::GoalArguments goal;
  cli::OrderArguments order;
  cli::NetworkArguments network;
  std::size_t count = 0;
  std::string activity;  // whose values are asked for
  std::vector<std::string> timelines;
  std::string mission;  // folder or name, for what its file says
  std::int64_t launcher = 0;
  cli::ReachArguments reach;
  cli::map::MapArguments map;
  cli::outlook::OutlookArguments outlook;
  std::uint32_t version = 0;
  std::vector<double> from;
  bool prunes = false;
  std::size_t kept = 20;
  int (*verb)(lib::Client&, const Line&) = nullptr;
  int (*own)(const Line&) = nullptr;  // of a verb that joins no mission
};

// What the file of the mission says, as far as it stands on this machine.
cli::MissionWords words_of(const Line& line) {
  if (!line.mission.empty())
    return cli::read_mission_words(roci::services::process::mission_folder(line.mission));
  const auto run = lib::local_run(line.connection, line.launcher);
  if (!run || run->mission.empty()) return {};
  try {
    return cli::read_mission_words(run->mission);
  } catch (const roci::mission::FileError& error) {
    std::cerr << "roci: " << error.what() << "\n";  // it flies, whatever the file says now
    return {};
  }
}

int list_goal_kinds(const Line& line) {
  if (line.mission.empty() && !lib::local_run(line.connection)) {
    try {
      lib::choose_run(line.connection);
    } catch (const std::runtime_error& error) {
      std::cerr << "roci: " << error.what() << "\n";
      return cli::kNoMission;
    }
    std::cerr << "roci: that mission's files are not on this machine; name one: roci goal kinds MISSION\n";
    return cli::kNoMission;
  }
  const cli::MissionWords words = words_of(line);
  std::cout << (line.json ? cli::json_text(cli::goal_kinds_json(words)) + "\n" : cli::goal_kinds_text(words));
  return cli::kDone;
}

void add_connection_options(CLI::App& app, Line& line) {
  app.add_option("--domain", line.connection.domain,
                 "DDS domain of the mission (default: the one that runs here)");
  app.add_option("--dds", line.connection.dds, "fastdds or cyclonedds");
  app.add_option("--address", line.connection.address, "This host's address");
  app.add_option("--peers", line.connection.peers, "Addresses of the hosts, separated by commas");
  app.add_option("--network", line.connection.network, "Network file of this host");
  app.add_flag(roci::services::process::kSecureFlag, line.connection.secure,
               roci::services::process::kSecureHelp);
  app.add_option("--executive", line.executive,
                 "Whose mission and plan, where several fly (default: the first by name)");
}

CLI::App* add_verb(CLI::App& parent, Line& line, const char* name, const char* help,
                   int (*verb)(lib::Client&, const Line&)) {
  CLI::App* command = parent.add_subcommand(name, help);
  command->add_flag("--json", line.json, "Print JSON");
  command->callback([&line, verb] { line.verb = verb; });
  return command;
}

void add_goal_verbs(CLI::App& app, Line& line) {
  CLI::App* goal = app.add_subcommand("goal", "Ask for something, take it back, list what was asked");
  goal->require_subcommand(1);
  CLI::App* add =
      add_verb(*goal, line, "add", "Send a goal and wait until it stands in the robot's journal",
               [](lib::Client& client, const Line& l) { return cli::add_goal(client, l.goal, l.json); });
  add->add_option("id", line.goal.id, "A name of your choice")->required();
  add->add_option("kind", line.goal.kind, "One of the mission's goal kinds, e.g. photo")->required();
  add->add_option("arguments", line.goal.arguments, "name=value …, e.g. x=110 y=60");
  add->add_option(
         "--importance,--class", line.goal.importance,
         "hard (the mission fails without it), optional (may be dropped) or opportunistic (goes first)")
      ->capture_default_str();
  add->add_option("--robot", line.goal.robot, "The robot that is to achieve it (default: the only one)");
  add->add_option("--utility", line.goal.utility,
                  "Among optional goals the lowest goes first; several by rank, the highest first: 2,0.5")
      ->delimiter(',');
  add->add_option("--priority", line.goal.priority,
                  "Of goals worth the same, the lowest leaves first where not all fit");
  add->add_option("--opens", line.goal.opens_s,
                  "Earliest mission time in seconds, for kinds with a window (roci goal kinds)");
  add->add_option("--closes", line.goal.closes_s, "Latest mission time in seconds, likewise");
  add->add_option("--issuer", line.goal.issuer, "Who asks")->capture_default_str();
  add->add_flag("--wait", line.goal.waits,
                "Wait for the goal's end: exit code 0 achieved, 4 dropped, failed or recalled, 5 the mission "
                "ended first");
  add->add_flag("--why", line.goal.why, "With --wait: why it was given up, in the planner's own words too");
  CLI::App* cancel =
      add_verb(*goal, line, "cancel", "Take a goal back", [](lib::Client& client, const Line& l) {
        return cli::cancel_goal(client, l.goal.issuer, l.goal.id, l.json);
      });
  cancel->add_option("id", line.goal.id, "The goal's id")->required();
  cancel->add_option("--issuer", line.goal.issuer, "Who asked")->capture_default_str();
  CLI::App* list = add_verb(
      *goal, line, "list", "All goals with their states and reasons",
      [](lib::Client& client, const Line& l) { return cli::list_goals(client, l.goal.why, l.json); });
  list->add_flag("--why", line.goal.why, "The reasons in the planner's own words, too");
  CLI::App* kinds = add_verb(*goal, line, "kinds", "What may be asked for, with an example of each", nullptr);
  kinds->add_option("mission", line.mission, "Mission folder or name (default: the one that runs here)");
  kinds->callback([&line] { line.own = list_goal_kinds; });
}

CLI::App* add_order(CLI::App& parent, Line& line, const char* name, const char* help,
                    roci::v1::OrderKind kind) {
  CLI::App* command = add_verb(parent, line, name, help, [](lib::Client& client, const Line& l) {
    return cli::give_order(client, l.order, l.json);
  });
  command->preparse_callback([&line, kind](std::size_t) { line.order.kind = kind; });
  command->add_option("--id", line.order.id, "A name of your choice; the same again is given once");
  command->add_option("--issuer", line.order.issuer, "Who orders")->capture_default_str();
  command->add_option("--robot", line.order.robot, "Whose executive (default: the only one)");
  return command;
}

void add_order_verbs(CLI::App& app, Line& line) {
  CLI::App* order = app.add_subcommand("order", "Order the executive; prints what becomes of the order");
  order->require_subcommand(1);
  add_order(*order, line, "hold", "Nothing new starts, or one activity does not", roci::v1::ORDER_HOLD)
      ->add_option("activity", line.order.target, "It alone, as roci plan names it");
  add_order(*order, line, "release", "End the hold, or that of one activity", roci::v1::ORDER_RELEASE)
      ->add_option("activity", line.order.target, "It alone");
  add_order(*order, line, "approve", "At autonomy E1: let an activity start", roci::v1::ORDER_APPROVE)
      ->add_option("activity", line.order.target, "As roci plan names it")
      ->required();
  CLI::App* command =
      add_order(*order, line, "command", "Command a component directly, and wait for the result",
                roci::v1::ORDER_APPROVE);
  command->add_option("component", line.order.target, "As mission.yaml names it")->required();
  command->add_option("command", line.order.command, "What it is to do")->required();
  command->add_option("arguments", line.order.command_arguments, "NAME=VALUE, as many as it takes");
  CLI::App* set =
      add_order(*order, line, "set", "Set the value of a timeline that the mission gives to the ground",
                roci::v1::ORDER_SET_VALUE);
  set->add_option("timeline", line.order.target, "Its name")->required();
  set->add_option("value", line.order.value, "true, false, a number, or a state with its arguments")
      ->required();
  add_order(*order, line, "autonomy", "Set the level of autonomy", roci::v1::ORDER_AUTONOMY)
      ->add_option(
          "level", line.order.level,
          "E1: each activity is approved; E2: no recovery on board, a broken plan makes safe; E3: retries "
          "and contingencies; E4: everything")
      ->required();
  CLI::App* upload = add_order(*order, line, "upload", "Replace something on board, whole or not at all",
                               roci::v1::ORDER_UPLOAD);
  upload
      ->add_option("target", line.order.target, "What the mission lets you replace, e.g. contingencies.NAME")
      ->required();
  upload->add_option("file", line.order.file, "The new content")->required();
  CLI::App* answer =
      add_order(*order, line, "answer", "Answer a decision; without arguments: list the open ones",
                roci::v1::ORDER_ANSWER);
  answer->add_option("decision", line.order.target, "As roci decisions names it");
  answer->add_option("choice", line.order.choice, "One of its choices");
  answer->add_option("--value", line.order.bound, "For a decision that asks for a value");
  answer->callback([&line] {
    line.verb = [](lib::Client& client, const Line& l) {
      return l.order.target.empty() ? cli::list_decisions(client, l.json)
                                    : cli::give_order(client, l.order, l.json);
    };
  });
  add_order(*order, line, "drop", "Leave out an activity that has not begun, or one of a stopped plan",
            roci::v1::ORDER_DROP)
      ->add_option("activity", line.order.target, "As roci plan names it")
      ->required();
  add_order(*order, line, "relaunch", "Let the plan that was stopped go on with what is left of it",
            roci::v1::ORDER_RELAUNCH);
  add_order(*order, line, "safe", "Make the robot safe now, and hold it", roci::v1::ORDER_SAFE);
  add_verb(app, line, "decisions", "Decisions of the running plan that are open",
           [](lib::Client& client, const Line& l) { return cli::list_decisions(client, l.json); });
}

void add_network_verbs(CLI::App& app, Line& line) {
  CLI::App* network =
      app.add_subcommand("network", "The task network that the planner has, and its parameters");
  network->require_subcommand(1);
  const auto add = [&](const char* name, const char* help) {
    CLI::App* verb = add_verb(*network, line, name, help, [](lib::Client& client, const Line& l) {
      return cli::order_network(client, l.network, l.json);
    });
    verb->add_option("--id", line.network.id, "A name of your choice, so that a repetition is recognised");
    verb->add_option("--issuer", line.network.issuer, "Who gives the order")->capture_default_str();
    verb->add_option("--robot", line.network.robot, "Whose planner (default: the only one)");
    return verb;
  };
  CLI::App* upload = add("upload", "Replace the network, whole or not at all");
  upload
      ->add_option("file", line.network.file,
                   "A network, as YAML or in binary form; it is checked here first")
      ->required();
  CLI::App* set = add("set", "Set a parameter of the network, e.g. a duration");
  set->add_option("parameter", line.network.parameter, "Its name in the network")->required();
  set->add_option("value", line.network.value, "A number within the parameter's range")->required();
  add_verb(*network, line, "status", "Which network is in force, and where orders about it stand",
           [](lib::Client& client, const Line& l) { return cli::show_networks(client, l.json); });
}

void add_outlook_verbs(CLI::App& app, Line& line) {
  using cli::outlook::Subject;
  const auto add = [&](const char* name, Subject subject, const char* help) {
    CLI::App* verb = add_verb(app, line, name, help, [](lib::Client& client, const Line& l) {
      return cli::outlook::show_outlook(client, l.outlook, l.json);
    });
    verb->preparse_callback([&line, subject](std::size_t) { line.outlook.subject = subject; });
    verb->add_option("--svg", line.outlook.svg, "Write it as a picture to this file");
    verb->add_option("--robot", line.outlook.robot,
                     "Whose planner (default: the only one, or the first by name)");
  };
  add("downlinks", Subject::downlinks,
      "Which data go to Earth with which downlink, what is left out, and why");
  add("utility", Subject::utility, "What the chains of the plan and all data are worth, rank by rank");
  add("energy", Subject::energy, "The energy at the end of each planned task, with worst and best case");
  add("chains", Subject::chains,
      "The whole mission over time: chains of tasks that were done and that are planned");
  add("subway", Subject::subway, "The science subway map: sites, targets, outcomes, and which is next");
}

void add_mission_verbs(CLI::App& app, Line& line) {
  add_verb(app, line, "status", "Mission, goals, services, newest values",
           [](lib::Client& client, const Line& l) { return cli::show_status(client, words_of(l), l.json); });
  add_verb(app, line, "plan", "The running plan and the state of each activity",
           [](lib::Client& client, const Line& l) { return cli::show_plan(client, l.activity, l.json); })
      ->add_option("--why", line.activity,
                   "Instead: the function values that this activity stands on (its id, or its name for all "
                   "of that name)");
  add_verb(app, line, "executed", "A plan that has ended, with real times and what its commands brought",
           [](lib::Client& client, const Line& l) { return cli::show_executed(client, l.version, l.json); })
      ->add_option("version", line.version, "Of the plan (default: the one that ended last)");
  CLI::App* timelines =
      add_verb(app, line, "timelines", "Planned, executed and projected values of every timeline",
               [](lib::Client& client, const Line& l) {
                 return cli::show_timelines(client, l.timelines, words_of(l), l.json);
               });
  timelines->add_option("names", line.timelines, "Every change of these alone, e.g. rover.nav rover.battery");
  timelines->add_option("--mission", line.mission,
                        "Mission folder or name, for the units (default: as it runs here)");
}

void add_ground_verbs(CLI::App& app, Line& line) {
  CLI::App* reach = add_verb(app, line, "reach", "Is there a way to a place, how long, how much energy",
                             [](lib::Client& client, const Line& l) {
                               cli::ReachArguments asked = l.reach;
                               if (l.from.size() == 2) {
                                 asked.from_x_m = l.from[0];
                                 asked.from_y_m = l.from[1];
                               }
                               return cli::show_reach(client, asked, l.json);
                             });
  reach->add_option("x", line.reach.x_m, "Metres in the frame of the map")->required();
  reach->add_option("y", line.reach.y_m, "Metres in the frame of the map")->required();
  reach->add_option("--from", line.from, "Where the way begins: X Y (default: where the robot is)")
      ->expected(2);
  reach->add_option("--robot", line.reach.robot, "From where this robot is (default: the only one)");
  reach->add_option("--service", line.reach.service,
                    "The path planner that is asked (default: the robot's own, or the only one)");
  CLI::App* map =
      add_verb(app, line, "map", "Draw the ground with hazards, zones, planned and driven ways", nullptr);
  map->add_option("--png", line.map.png, "Write the ground as a picture to this file");
  map->add_option(
      "--svg", line.map.svg,
      "Write to this file what each robot knows of the ground, their ways, and what timelines showed when");
  map->add_option("--mission", line.map.mission,
                  "Mission folder or name: it alone is drawn, unless a run is named, too");
  map->add_option("--run", line.map.run,
                  "Run folder, as roci runs lists them (default: the run on this machine, if any)");
  map->callback(
      [&line] { line.own = [](const Line& l) { return cli::map::show_map(l.map, l.connection, l.json); }; });
}

void add_run_verbs(CLI::App& app, Line& line) {
  CLI::App* runs = add_verb(app, line, "runs", "The runs of this machine: when, what, result, size", nullptr);
  runs->add_flag("--prune", line.prunes, "Remove the folders of all but the newest runs");
  runs->add_option("--keep", line.kept, "With --prune: so many stay")->capture_default_str();
  runs->callback(
      [&line] { line.own = [](const Line& l) { return cli::show_runs(l.prunes, l.kept, l.json); }; });
  CLI::App* events = add_verb(
      app, line, "events", "What happens, as it happens",
      [](lib::Client& client, const Line& l) { return cli::follow_events(client, l.count, l.json); });
  events->add_option("--count", line.count, "End after so many events");
  CLI::App* watching =
      add_verb(app, line, "watch", "Live view of the mission in the terminal; waits for one to run",
               [](lib::Client& client, const Line& l) {
                 return cli::watch::watch(client, words_of(l), l.launcher != 0, l.json);
               });
  watching->preparse_callback([&line](std::size_t) { line.waits = true; });
  events->add_option("--launcher", line.launcher, "Join the run of this roci-launch, by its process id");
  watching->add_option("--launcher", line.launcher, "Join the run of this roci-launch, by its process id");
}

void tell_waiting() {
  std::cerr << "roci: no mission runs on this machine yet; waiting for one (Ctrl-C ends, ./run starts one)\n";
}

int carry_out(Line& line) {
  try {
    if (line.own != nullptr) return line.own(line);
    if (line.launcher != 0 && !lib::wait_for_launcher(line.launcher)) return cli::kNoMission;
    lib::Client client(line.waits && line.launcher == 0 ? lib::wait_for_run(line.connection, tell_waiting)
                                                        : lib::choose_run(line.connection, line.launcher));
    client.look_at(line.executive);
    client.watch_launcher(line.launcher);
    return line.verb(client, line);
  } catch (const std::invalid_argument& error) {
    std::cerr << "roci: " << error.what() << "\n";
    return cli::kBadUsage;
  } catch (const std::exception& error) {
    std::cerr << "roci: " << error.what() << "\n";
    return cli::kNoMission;
  }
}

// The program beside this one takes over; it knows the executive or the planner's networks, the ground tool does not.
int become(const std::string& name, std::vector<std::string> arguments) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
  arguments.insert(arguments.begin(), name);
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  std::cerr << "roci: cannot start " << program.string() << "; install it beside roci\n";
  return cli::kBadUsage;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "replay") return become("roci-replay", {argv + 2, argv + argc});
  // The subcommand has the same name there.
  if (argc > 1 && std::string(argv[1]) == "explain") return become("roci-network", {argv + 1, argv + argc});
  Line line;
  CLI::App app("Ground tool of Rocinante");
  app.require_subcommand(1);
  app.fallthrough();
  add_connection_options(app, line);
  add_goal_verbs(app, line);
  add_order_verbs(app, line);
  add_network_verbs(app, line);
  add_outlook_verbs(app, line);
  add_mission_verbs(app, line);
  add_ground_verbs(app, line);
  add_run_verbs(app, line);
  app.add_subcommand("replay", "Repeat a run from its journal: roci replay JOURNAL (--help tells more)");
  app.add_subcommand("explain",
                     "Why a task of a network is not planned: roci explain NETWORK TASK (--help tells more)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const std::string verb =
        cli::words_on_verb(app, {argv + 1, argv + argc},
                           {"--domain", "--dds", "--address", "--peers", "--network", "--executive"});
    if (error.get_exit_code() == 0 || verb.empty()) return app.exit(error) == 0 ? cli::kDone : cli::kBadUsage;
    std::cerr << "roci: " << verb << "\n";
    return cli::kBadUsage;
  }
  return carry_out(line);
}
