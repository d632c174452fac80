#include "rehearsal/check/action_check.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>

#include "core/pddl/ast.hpp"
#include "core/pddl/types.hpp"
#include "rehearsal/check/component_check.hpp"
#include "rehearsal/check/words.hpp"

namespace roci::rehearsal::check {

using mission::Entry;

namespace {

// "?2.x": the second parameter's property x; the property is empty in "?2".
struct Reference {
  std::size_t position = 0;
  std::string property;
};

std::optional<Reference> reference_in(const std::string& text) {
  if (text.size() < 2 || text[0] != '?' || std::isdigit(static_cast<unsigned char>(text[1])) == 0)
    return std::nullopt;
  const std::string property = text.size() > 3 && text[2] == '.' ? text.substr(3) : "";
  return Reference{static_cast<std::size_t>(text[1] - '0'), property};
}

// An object of the file, or of one of its goal kinds.
struct Object {
  Entry entry;
  std::string name;
  std::string type;
  std::vector<std::string> properties;
};

std::vector<Object> objects_in(const Entry& parent) {
  std::vector<Object> out;
  const auto list = parent.find("objects");
  if (!list) return out;
  list->each([&](const Entry& entry) {
    Object& object = out.emplace_back(Object{entry, entry.at("name").text(), entry.text_or("type", ""), {}});
    if (const auto properties = entry.find("properties"))
      for (const auto& [name, value] : properties->fields()) object.properties.push_back(name);
  });
  return out;
}

std::vector<Object> all_objects(const Entry& file) {
  std::vector<Object> out = objects_in(file);
  if (const auto kinds = file.find("goal_kinds")) {
    kinds->each_field([&](const std::string&, const Entry& kind) {
      for (Object& object : objects_in(kind)) out.push_back(std::move(object));
    });
  }
  return out;
}

std::map<std::string, std::vector<pddl::TypedName>> parameters_in(const pddl::Domain& domain) {
  std::map<std::string, std::vector<pddl::TypedName>> out;
  for (const pddl::Action& action : domain.actions) out[action.name] = action.parameters;
  for (const pddl::DurativeAction& action : domain.durative_actions) out[action.name] = action.parameters;
  return out;
}

class ActionCheck {
 public:
  ActionCheck(const CheckedMission& mission, const CheckedExecutive& executive)
      : mission_(mission), executive_(executive), objects_(all_objects(executive.file)) {
    if (!executive.model.domain) return;
    types_.emplace(*executive.model.domain);
    parameters_ = parameters_in(*executive.model.domain);
  }

  // What an action or a contingency sends.
  void command(const Entry& entry) const {
    const Entry owner = entry.at("owner");
    require_owner(owner, mission_.services);
    if (owner.text() != mission_.world.service) return;
    const Entry name = entry.at("component");
    const auto& own = executive_.model.components;
    const auto component = std::ranges::find(own, name.text(), &exec::mission::Component::name);
    if (component == own.end()) return;  // told by the reader
    const SimulatedComponent* there = mission_.world.find(component->robot, component->name);
    if (there == nullptr || !there->known) return;  // told of the component
    const Entry wanted = entry.at("command");
    const auto form = std::ranges::find(there->commands, wanted.text(), &sim::world::CommandForm::name);
    if (form == there->commands.end())
      return wanted.complain("'" + component->name + "' has no command '" + wanted.text() + "'; " +
                             instead_of(wanted.text(), names_of(there->commands)));
    arguments(entry, *form);
  }

  void references(const std::string& action, const Entry& entry) const {
    const auto parameters = parameters_.find(action);
    const auto given = entry.find("arguments");
    if (parameters == parameters_.end() || !given) return;
    given->each_field([&](const std::string&, const Entry& value) {
      const auto reference = reference_in(value.text());
      if (!reference) return;
      if (reference->position == 0 || reference->position > parameters->second.size())
        value.fail("action '" + action + "' has " + std::to_string(parameters->second.size()) +
                   " parameters, and ?" + std::to_string(reference->position) +
                   " stands here; name one that there is");
      if (!reference->property.empty())
        property(action, value, reference->property, parameters->second[reference->position - 1]);
    });
  }

 private:
  void arguments(const Entry& entry, const sim::world::CommandForm& form) const {
    std::vector<std::string> given;
    const auto list = entry.find("arguments");
    if (list)
      for (const auto& [name, value] : list->fields()) given.push_back(name);
    for (const std::string& needed :
         form.missing([&](const std::string& one) { return contains(given, one); }))
      list.value_or(entry).complain("command '" + form.name + "' needs an argument '" + needed + "'; add it" +
                                    (given.empty() ? "" : " (given: " + joined(given) + ")"));
  }

  static std::string joined(const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
    return out;
  }

  // Of the objects that the parameter may stand for, all have the property that the command takes.
  void property(const std::string& action, const Entry& value, const std::string& name,
                const pddl::TypedName& parameter) const {
    std::vector<const Object*> without;
    std::vector<std::string> known;
    bool somewhere = false;
    for (const Object& object : objects_) {
      if (!types_->accepts(parameter.types, {object.type})) continue;
      const bool has = contains(object.properties, name);
      somewhere = somewhere || has;
      if (!has) without.push_back(&object);
      for (const std::string& one : object.properties)
        if (!contains(known, one)) known.push_back(one);
    }
    if (!somewhere && !known.empty())
      return value.complain("no object of type " + parameter.types.front() + " has a property '" + name +
                            "'; " + instead_of(name, known));
    for (const Object* object : without)
      object->entry.complain("object '" + object->name + "' has no property '" + name + "', which action '" +
                             action + "' hands to its command; add it under properties");
  }

  const CheckedMission& mission_;
  const CheckedExecutive& executive_;
  std::vector<Object> objects_;
  std::optional<pddl::TypeTree> types_;
  std::map<std::string, std::vector<pddl::TypedName>> parameters_;
};

}  // namespace

void check_actions(const CheckedMission& mission, const CheckedExecutive& executive) {
  const ActionCheck check(mission, executive);
  if (const auto actions = executive.file.find("actions")) {
    actions->each_field([&](const std::string& name, const Entry& action) {
      action.attempt([&] { check.command(action); });
      check.references(name, action);
    });
  }
  if (const auto contingencies = executive.file.find("contingencies")) {
    contingencies->each_field([&](const std::string&, const Entry& contingency) {
      contingency.at("commands").each([&](const Entry& command) { check.command(command); });
    });
  }
}

}  // namespace roci::rehearsal::check
