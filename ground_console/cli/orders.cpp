#include "ground_console/cli/orders.hpp"

#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/bytes/crc_32.hpp"
#include "ground_console/cli/executed_table.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/verbs.hpp"

namespace roci::console::cli {
namespace {

using nlohmann::json;

constexpr std::array kStages{"received", "accepted", "refused", "applied"};
constexpr std::array kLevels{"E1", "E2", "E3", "E4"};

v1::AutonomyLevel level_of(const std::string& text) {
  for (std::size_t i = 0; i < kLevels.size(); ++i)
    if (text == kLevels.at(i)) return static_cast<v1::AutonomyLevel>(i);
  throw std::invalid_argument("unknown level '" + text +
                              "'; one of: E1 (each activity is approved), E2 (no recovery on board), E3 (no "
                              "replanning on board), E4 (everything)");
}

v1::TimelineValue value_of(const std::vector<std::string>& words) {
  v1::TimelineValue out;
  if (words.empty()) return out;
  const std::string& first = words.front();
  double number = 0;
  const auto [end, error] = std::from_chars(first.data(), first.data() + first.size(), number);
  if (words.size() == 1 && (first == "true" || first == "false")) {
    out.kind(v1::VALUE_BOOLEAN);
    out.truth(first == "true");
  } else if (words.size() == 1 && error == std::errc{} && end == first.data() + first.size()) {
    out.kind(v1::VALUE_NUMBER);
    out.number(number);
  } else {
    out.kind(v1::VALUE_STATE);
    out.state(first);
    out.arguments({words.begin() + 1, words.end()});
  }
  return out;
}

void fill_upload(v1::Order& order, const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw std::invalid_argument("cannot read '" + file + "'; name a file with the new content");
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  order.upload().assign(content.begin(), content.end());
  order.checksum(bytes::crc_32(content));
}

// A command goes as an approval with its content.
void fill_command(v1::Order& order, const OrderArguments& arguments) {
  for (const std::string& argument : arguments.command_arguments)
    if (argument.find('=') == std::string::npos || argument.front() == '=')
      throw std::invalid_argument("argument '" + argument + "' is no NAME=VALUE, e.g. to=w1");
  order.content().kind(v1::VALUE_STATE);
  order.content().state(arguments.command);
  order.content().arguments(arguments.command_arguments);
}

json to_json(const v1::OrderStatus& status) {
  return {{"issuer", status.issuer()},
          {"id", status.id()},
          {"stage", kStages.at(static_cast<std::size_t>(status.stage()))},
          {"reason", status.reason()},
          {"plan_version", status.plan_version()},
          {"acknowledged", lib::name_of(status.ack_stage())}};
}

std::string alternatives(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " or ") + word;
  return printable(out);
}

}  // namespace

v1::Order order_of(const OrderArguments& arguments) {
  v1::Order order;
  order.issuer(arguments.issuer);
  order.id(arguments.id);
  order.robot(arguments.robot);
  order.order_kind(arguments.kind);
  order.target(arguments.target);
  order.choice(arguments.choice);
  order.autonomy(arguments.kind == v1::ORDER_AUTONOMY ? level_of(arguments.level) : v1::AUTONOMY_E4);
  if (arguments.kind == v1::ORDER_SET_VALUE) order.content(value_of(arguments.value));
  if (arguments.kind == v1::ORDER_ANSWER && !arguments.bound.empty()) {
    order.content().kind(v1::VALUE_STATE);
    order.content().state(arguments.bound);
  }
  if (!arguments.command.empty()) fill_command(order, arguments);
  if (arguments.kind == v1::ORDER_UPLOAD) fill_upload(order, arguments.file);
  return order;
}

namespace {

// What became of a single command, of which the plan is told with the order.
int await_command(lib::Client& client, const v1::OrderStatus& order, const std::string& command,
                  bool as_json) {
  const std::string activity = "p" + std::to_string(order.plan_version()) + ".1-" + command;
  const auto ended = [&]() -> const v1::ExecutedActivity* {
    for (const auto& [version, plan] : client.view().executed())
      for (const v1::ExecutedActivity& one : plan.activities())
        if (one.id() == activity && one.ended_us() >= 0) return &one;
    return nullptr;
  };
  const bool heard =
      client.wait([&] { return ended() != nullptr || client.view().ended(); }, std::chrono::hours(24));
  if (!heard || (ended() == nullptr &&
                 !client.wait([&] { return ended() != nullptr; }, std::chrono::milliseconds(500)))) {
    std::cerr << "roci: the mission ended before the command did\n";
    return kStillOpen;
  }
  const v1::ExecutedActivity& result = *ended();
  std::cout << (as_json ? json_text(executed_json(result)) : executed_line(result)) << std::endl;
  return result.state() == v1::ACTIVITY_SUCCEEDED ? kDone : kNotAchieved;
}

}  // namespace

int give_order(lib::Client& client, const OrderArguments& arguments, bool as_json) {
  v1::Order order = order_of(arguments);
  if (order.id().empty()) order.id(client.name());
  const auto last = client.send_order(
      order,
      [as_json](const v1::OrderStatus& status) {
        std::cout << (as_json ? json_text(to_json(status)) : stage_line(status)) << std::endl;
      },
      kAnswerLimit);
  if (!last) {
    std::cerr << "roci: no executive"
              << (arguments.robot.empty() ? "" : " of robot '" + arguments.robot + "'") << " answered within "
              << kAnswerLimit.count() / 1000
              << (client.view().mission() != nullptr ? kOnItsWay
                                                     : " s; is the mission running there (roci status)?\n");
    return kNoMission;
  }
  if (last->stage() == v1::ORDER_REFUSED) return kRefused;
  if (!arguments.command.empty()) return await_command(client, *last, arguments.command, as_json);
  if (last->stage() != v1::ORDER_APPLIED)
    std::cerr << "roci: it stands in the robot's journal and is applied when its time has come\n";
  return kDone;
}

int list_decisions(lib::Client& client, bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) {
    std::cerr << "roci: no mission answers; is it running there (roci status)?\n";
    return kNoMission;
  }
  client.catch_up();
  json list = json::array();
  for (const auto& [id, decision] : client.view().decisions()) {
    if (decision.decision_state() != v1::DECISION_OPEN) continue;
    list.push_back(decision_json(decision));
    if (!as_json) std::cout << decision_line(decision) << "\n";
  }
  if (as_json) {
    std::cout << json_text(list) << "\n";
  } else if (list.empty()) {
    std::cout << "no decision is open\n";
  }
  return kDone;
}

std::string stage_line(const v1::OrderStatus& status) {
  std::string out =
      status.issuer() + "/" + status.id() + "  " + kStages.at(static_cast<std::size_t>(status.stage()));
  if (status.stage() == v1::ORDER_APPLIED && status.plan_version() != 0)
    out += " in plan " + std::to_string(status.plan_version());
  return printable(status.reason().empty() ? out : out + ": " + status.reason());
}

json decision_json(const v1::Decision& decision) {
  return {{"id", decision.id()},
          {"resolver", decision.resolver()},
          {"choices", decision.choices()},
          {"admissible", decision.admissible()},
          {"answer_before_us", decision.answer_before_us()},
          {"plan_version", decision.plan_version()}};
}

std::string decision_line(const v1::Decision& decision) {
  std::string out = printable(decision.id()) + ": ";
  if (!decision.choices().empty()) {
    out += alternatives(decision.choices());
  } else {
    out += "a value" + (decision.admissible().empty() ? "" : ", " + alternatives(decision.admissible()));
  }
  out += "? asked of " + printable(decision.resolver());
  if (decision.answer_before_us() >= 0) out += ", before " + lib::clock_text(decision.answer_before_us());
  return out;
}

}  // namespace roci::console::cli
