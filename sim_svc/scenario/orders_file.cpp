#include "sim_svc/scenario/orders_file.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <utility>

namespace roci::sim::scenario {

using mission::Entry;

namespace {

constexpr std::pair<const char*, OrderKind> kKinds[]{
    {"hold", OrderKind::hold},         {"release", OrderKind::release}, {"approve", OrderKind::approve},
    {"autonomy", OrderKind::autonomy}, {"answer", OrderKind::answer},   {"drop", OrderKind::drop},
    {"relaunch", OrderKind::relaunch}, {"safe", OrderKind::safe},       {"command", OrderKind::command}};

OrderKind read_kind(const Entry& entry) {
  const std::string word = entry.text();
  std::string known;
  for (const auto& [name, kind] : kKinds) {
    if (name == word) return kind;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  entry.fail("unknown order '" + word + "'; known: " + known);
}

OrderStimulus read_key(const Entry& entry) {
  OrderStimulus out;
  out.issuer = entry.text_or("issuer", "ground");
  out.id = entry.at("id").text();
  out.robot = entry.text_or("robot", "");
  return out;
}

int read_level(const Entry& entry) {
  const std::string text = entry.text();
  if (text.size() != 2 || text[0] != 'E' || text[1] < '1' || text[1] > '4')
    entry.fail("unknown level '" + text + "'; one of: E1, E2, E3, E4");
  return text[1] - '0';
}

void read_answer(const Entry& entry, OrderStimulus& out) {
  out.target = entry.at("decision").text();
  const auto value = entry.find("value");
  if (value && entry.find("choice")) entry.fail("it names a choice or binds a value; keep one");
  if (value) {
    out.value = temporal::state(value->text());
  } else {
    out.choice = entry.at("choice").text();
  }
}

void read_command(const Entry& entry, OrderStimulus& out) {
  out.target = entry.at("component").text();
  temporal::State command{entry.at("command").text(), {}};
  if (const auto arguments = entry.find("arguments"))
    for (const auto& [name, value] : arguments->fields())
      command.arguments.push_back(name + "=" + value.text());
  out.value = std::move(command);
}

}  // namespace

OrderStimulus read_set(const Entry& entry) {
  entry.allow_only({"issuer", "id", "robot", "timeline", "value"});
  OrderStimulus out = read_key(entry);
  out.kind = OrderKind::set_value;
  out.target = entry.at("timeline").text();
  const std::string text = entry.at("value").text();
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text == "true" || text == "false") {
    out.value = text == "true";
  } else if (error == std::errc{} && end == text.data() + text.size() && std::isfinite(number)) {
    out.value = number;
  } else {
    out.value = temporal::state(text);
  }
  return out;
}

OrderStimulus read_order(const Entry& entry) {
  OrderStimulus out = read_key(entry);
  out.kind = read_kind(entry.at("kind"));
  switch (out.kind) {
    case OrderKind::hold:
    case OrderKind::release:  // without an activity: of everything
      entry.allow_only({"issuer", "id", "robot", "kind", "activity"});
      out.target = entry.text_or("activity", "");
      break;
    case OrderKind::approve:
    case OrderKind::drop:
      entry.allow_only({"issuer", "id", "robot", "kind", "activity"});
      out.target = entry.at("activity").text();
      break;
    case OrderKind::autonomy:
      entry.allow_only({"issuer", "id", "robot", "kind", "level"});
      out.level = read_level(entry.at("level"));
      break;
    case OrderKind::answer:
      entry.allow_only({"issuer", "id", "robot", "kind", "decision", "choice", "value"});
      read_answer(entry, out);
      break;
    case OrderKind::command:
      entry.allow_only({"issuer", "id", "robot", "kind", "component", "command", "arguments"});
      read_command(entry, out);
      break;
    case OrderKind::set_value:  // a stimulus of its own
    case OrderKind::relaunch:
    case OrderKind::safe:
      entry.allow_only({"issuer", "id", "robot", "kind"});
      break;
  }
  return out;
}

}  // namespace roci::sim::scenario
