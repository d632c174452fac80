#include "arm_svc/functions.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "core/mission/entry.hpp"

namespace roci::arm {
namespace {

using mission::Entry;

// A name that a PDDL text can have: letters, digits, - and _, a letter first.
std::string name_in(const Entry& where, const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  const bool begins =
      !name.empty() && ((name[0] >= 'a' && name[0] <= 'z') || (name[0] >= 'A' && name[0] <= 'Z'));
  if (!begins || !std::ranges::all_of(name, plain))
    where.fail("'" + name + "' is no name of PDDL; use letters, digits, - and _, a letter first");
  return name;
}

// Splits "?2" and "?2.key" into the argument, counted from 0, and the key; nothing for other texts.
std::optional<ArgumentProperty> argument_of(const Entry& entry, const std::string& text, std::size_t arity) {
  if (!text.starts_with('?')) return std::nullopt;
  std::size_t number = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data() + 1, last, number);
  if (error != std::errc() || number < 1 || (end != last && *end != '.'))
    entry.fail("'" + text + "' is no argument; write ?1 for the first, ?1.key for a property of it");
  if (number > arity) {
    entry.fail("the function has " + std::to_string(arity) + " parameters, so there is no ?" +
               std::to_string(number));
  }
  return ArgumentProperty{number - 1, end == last ? std::string() : std::string(end + 1, last)};
}

PlaceTerm place_term(const Entry& entry, std::size_t arity, const ArmSetup& setup) {
  const std::string text = entry.text();
  if (const auto argument = argument_of(entry, text, arity)) {
    if (!argument->key.empty()) entry.fail("a place is a whole argument such as ?1, no property of it");
    return argument->argument;
  }
  if (std::ranges::find(setup.poses, text, &NamedPose::name) == setup.poses.end())
    entry.fail("'" + text + "' is no pose of the arm's file of poses; name one, or an argument such as ?1");
  return text;
}

NumberTerm number_term(const Entry& entry, std::size_t arity) {
  const std::string text = entry.text();
  if (const auto argument = argument_of(entry, text, arity)) {
    if (argument->key.empty()) entry.fail("say which property: ?1.mass_kg, not ?1");
    return *argument;
  }
  const double value = entry.number();
  if (value < 0) entry.fail("must be 0 or more");
  return value;
}

PayloadTerm payload_term(const Entry& entry, std::size_t arity) {
  entry.allow_only({"mass_kg", "size_m"});
  PayloadTerm payload{number_term(entry.at("mass_kg"), arity), std::nullopt};
  const auto size = entry.find("size_m");
  if (!size) return payload;
  const std::vector<Entry> edges = size->items();
  if (edges.size() != 3) size->fail("needs three edges, along x, y and z of the tool");
  payload.size_m.emplace();
  for (std::size_t i = 0; i < 3; ++i) (*payload.size_m)[i] = number_term(edges[i], arity);
  return payload;
}

Quantity quantity(const Entry& entry) {
  const std::string text = entry.text();
  if (text == "duration") return Quantity::duration;
  if (text != "energy") entry.fail("'" + text + "' is neither duration (s) nor energy (J)");
  return Quantity::energy;
}

ArmFunction function(const std::string& name, const Entry& entry, const ArmSetup& setup) {
  entry.allow_only({"parameters", "gives", "from", "to", "payload"});
  ArmFunction function;
  function.name = name_in(entry, name);
  const Entry parameters = entry.at("parameters");
  for (const std::string& type : parameters.texts()) function.parameters.push_back(name_in(parameters, type));
  const std::size_t arity = function.parameters.size();
  function.gives = quantity(entry.at("gives"));
  function.from = place_term(entry.at("from"), arity, setup);
  function.to = place_term(entry.at("to"), arity, setup);
  if (const auto payload = entry.find("payload")) function.payload = payload_term(*payload, arity);
  return function;
}

}  // namespace

ArmModule default_module() {
  const std::vector<std::string> poses{"pose", "pose"};
  ArmModule module;
  module.functions = {{"arm_move_time", poses, Quantity::duration, std::size_t{0}, std::size_t{1}},
                      {"arm_move_energy", poses, Quantity::energy, std::size_t{0}, std::size_t{1}}};
  return module;
}

ArmModule read_module(const Entry& arm, const ArmSetup& setup) {
  ArmModule module = default_module();
  if (const auto name = arm.find("module")) module.name = name_in(*name, name->text());
  const auto functions = arm.find("functions");
  if (!functions) return module;
  module.functions.clear();
  for (const auto& [name, entry] : functions->fields()) {
    if (std::ranges::find(module.functions, name, &ArmFunction::name) != module.functions.end())
      entry.fail("function '" + name + "' stands twice; give it another name");
    module.functions.push_back(function(name, entry, setup));
  }
  if (module.functions.empty()) functions->fail("names no function; leave it out for the two usual ones");
  return module;
}

}  // namespace roci::arm
