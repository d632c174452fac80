#include "sim_svc/components/grapple_settings.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/words/nearest_word.hpp"

namespace roci::sim::components {

using mission::Entry;
using setup::Settings;

namespace {

using Names = std::vector<std::string>;

template <class Things>
Names names_of(const Things& things) {
  Names out;
  for (const auto& [name, thing] : things) out.push_back(name);
  return out;
}

double mass_of(const Entry& entry) {
  const double mass = entry.number();
  if (!(mass > 0)) entry.fail("a mass must be above 0 kg; correct the number");
  return mass;
}

std::vector<double> size_of(const Entry& entry) {
  std::vector<double> out;
  for (const Entry& edge : entry.items()) {
    out.push_back(edge.number());
    if (!(out.back() > 0)) edge.fail("an edge must be longer than 0 m; correct the number");
  }
  if (out.size() != 3) entry.fail("expected three edges such as [0.5, 0.5, 0.5], in m; correct the list");
  return out;
}

bool works(const Entry& entry) {
  const std::string text = entry.text();
  if (text != "works" && text != "damaged")
    entry.fail("unknown health '" + text + "'; known: works, damaged" +
               words::did_you_mean(text, {"works", "damaged"}));
  return text == "works";
}

// Returns the names of the arm's poses, and the file that has them; nothing in a mission without an arm.
std::optional<std::pair<Names, std::string>> poses_of(Settings& in) {
  const auto own = in.find("poses");
  const auto arm = in.mission().find("arm");
  const auto file = own ? own : arm ? arm->find("poses") : std::nullopt;
  if (!file) return std::nullopt;
  const Entry poses = Entry::load(file->resolve(file->text()));
  Names names;
  for (const auto& [name, pose] : poses.at("poses").fields()) names.push_back(name);
  return std::pair(names, poses.file().string());
}

class StructureReader {
 public:
  StructureReader(GrappleSettings& out, Settings& in) : out_(out), poses_(poses_of(in)) {}

  void slots(const Entry& entry) {
    entry.each_field([&](const std::string& name, const Entry& value) { slot(name, value); });
  }

  void modules(const Entry& entry) {
    entry.each_field([&](const std::string& name, const Entry& value) { module(name, value); });
  }

  void blocked(const Entry& entry) {
    entry.each([&](const Entry& name) {
      const auto slot = out_.slots.find(name.text());
      if (slot == out_.slots.end()) name.fail(no_slot(name.text()));
      slot->second.blocked = true;
      blocks_.insert_or_assign(name.text(), name);
    });
  }

  // What concerns slots and modules together, when all of them are known.
  void check() const {
    std::map<std::string, std::string> inside;
    for (const auto& [name, module] : out_.modules) {
      const Entry& where = places_.at(name);
      const auto slot = out_.slots.find(module.slot);
      if (slot == out_.slots.end()) {
        where.complain(no_slot(module.slot));
        continue;
      }
      const auto [other, alone] = inside.emplace(module.slot, name);
      if (!alone)
        where.complain("'" + other->second + "' is in slot '" + module.slot + "' already (" +
                       places_.at(other->second).place() +
                       "); a slot has room for one module, move one of them");
      if (slot->second.blocked)
        blocks_.at(module.slot)
            .complain("slot '" + module.slot + "' cannot be blocked, '" + name +
                      "' is in it; block a free slot, or move the module");
    }
  }

 private:
  std::string no_slot(const std::string& name) const {
    return "no slot '" + name + "'; " +
           words::nearest(name, names_of(out_.slots)).remedy("add it to the grapple's slots in mission.yaml");
  }

  void slot(const std::string& name, const Entry& entry) {
    setup::check_name(name, entry);
    SlotSettings out{name};
    if (entry.is_mapping()) {
      entry.allow_only({"at", "blocked"});
      out.pose = entry.text_or("at", name);
      out.blocked = entry.truth_or("blocked", false);
    } else {
      out.pose = entry.text();
    }
    if (out.blocked) blocks_.insert_or_assign(name, entry);
    if (poses_ && std::ranges::find(poses_->first, out.pose) == poses_->first.end())
      entry.complain(
          "slot '" + name + "' has no pose: no pose '" + out.pose + "' stands in " + poses_->second + "; " +
          words::nearest(out.pose, poses_->first).remedy("add it there, or name another with at:"));
    if (!out_.slots.emplace(name, std::move(out)).second)
      entry.fail("slot '" + name + "' stands twice; rename one");
  }

  // A module that is known already keeps what the entry does not say.
  void module(const std::string& name, const Entry& entry) {
    setup::check_name(name, entry);
    entry.allow_only({"slot", "mass_kg", "true_mass_kg", "size_m", "health", "latch_tries"});
    const auto before = out_.modules.find(name);
    const bool is_new = before == out_.modules.end();
    ModuleSettings out = is_new ? ModuleSettings{} : before->second;
    if (const auto slot = is_new ? entry.at("slot") : entry.find("slot")) {
      out.slot = slot->text();
      places_.insert_or_assign(name, *slot);
    }
    if (const auto mass = is_new ? entry.at("mass_kg") : entry.find("mass_kg"))
      out.mass_kg = out.true_mass_kg = mass_of(*mass);
    if (const auto mass = entry.find("true_mass_kg")) out.true_mass_kg = mass_of(*mass);
    if (const auto size = entry.find("size_m")) out.size_m = size_of(*size);
    if (const auto health = entry.find("health")) out.works = works(*health);
    if (const auto tries = entry.find("latch_tries")) {
      out.latch_tries = tries->integer();
      if (out.latch_tries < 1 || out.latch_tries > 1000)
        tries->fail("a latch needs at least 1 try, and at most 1000; correct the number");
    }
    out_.modules.insert_or_assign(name, std::move(out));
  }

  GrappleSettings& out_;
  std::optional<std::pair<Names, std::string>> poses_;
  std::map<std::string, Entry> places_;  // module → where its slot is named
  std::map<std::string, Entry> blocks_;  // slot → where it is blocked
};

}  // namespace

GrappleSettings read_grapple_settings(Settings& in) {
  GrappleSettings out;
  out.localize_s = in.number("localize_s", out.localize_s);
  out.grasp_s = in.number("grasp_s", out.grasp_s);
  out.place_s = in.number("place_s", out.place_s);
  out.latch_s = in.number("latch_s", out.latch_s, 0.1);
  out.duration_noise = in.number("duration_noise", out.duration_noise);
  out.power_w = in.number("power_w", out.power_w);
  out.light = in.text("light", out.light);
  StructureReader reader(out, in);
  const auto slots = in.find("slots");
  if (!slots) in.component().fail("the grapple has nothing to work on; add slots: {s0: {}, s1: {}}");
  reader.slots(*slots);
  if (const auto modules = in.find("modules")) reader.modules(*modules);
  if (const auto& start = in.start()) {
    start->allow_only({"blocked", "modules"});
    if (const auto modules = start->find("modules")) reader.modules(*modules);
    if (const auto blocked = start->find("blocked")) reader.blocked(*blocked);
  }
  reader.check();
  return out;
}

}  // namespace roci::sim::components
