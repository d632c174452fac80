#include "exec_svc/goals/goal_set.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/words/nearest_word.hpp"
#include "exec_svc/goals/goal_merge.hpp"
#include "exec_svc/mission/template_text.hpp"

namespace roci::exec::goals {

using mission::ArgumentKind;
using mission::fill_names;
using mission::GoalKind;
using mission::ObjectModel;
using mission::words_of;

namespace {

// Returns whether the text can be a part of a PDDL name, as ids are.
bool is_name(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::islower(c) || std::isdigit(c) || c == '-' || c == '_';
  });
}

bool is_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

template <class Map>
std::string keys_of(const Map& map) {
  std::string out;
  for (const auto& [key, value] : map) out += (out.empty() ? "" : ", ") + key;
  return out;
}

constexpr std::size_t kBefore = 16;  // samples; of a goal few are on the topic at a time

bool same_sender(const SampleId& one, const SampleId& other) {
  return one.sender == other.sender && one.incarnation == other.incarnation;
}

// Returns whether the request was heard before the newest one, or comes from a restarted service that
// repeats itself: neither is a new wish.
bool is_old(const GoalRecord& record, const GoalRequest& request) {
  const SampleId& sample = request.sample;
  const bool heard = std::ranges::any_of(record.before, [&](const SampleId& before) {
    return same_sender(before, sample) && sample.number <= before.number;
  });
  const SampleId& own = record.request.sample;
  GoalRequest wish = record.request;
  wish.recalled = false;
  return heard || (own.incarnation > 0 && own.sender == sample.sender &&
                   sample.incarnation > own.incarnation && same_request(wish, request));
}

}  // namespace

void note_before(GoalRecord& record, const SampleId& sample) {
  if (sample.sender.empty() || same_sender(sample, record.answers)) return;
  const auto known = std::ranges::find_if(
      record.before, [&](const SampleId& before) { return same_sender(before, sample); });
  if (known != record.before.end()) {
    known->number = std::max(known->number, sample.number);
    return;
  }
  record.before.push_back(sample);
  if (record.before.size() > kBefore) record.before.erase(record.before.begin());
}

std::map<std::string, std::string> template_values(const GoalRequest& goal) {
  auto values = goal.arguments;
  values["id"] = goal.key.id;
  if (!goal.robot.empty()) values["robot"] = goal.robot;
  return values;
}

bool same_request(const GoalRequest& one, const GoalRequest& other) {
  GoalRequest said_likewise = one;
  said_likewise.sample = other.sample;
  return said_likewise == other;
}

bool from_console(const GoalRequest& goal) { return goal.sample.incarnation == 0; }

bool leaves_first(const GoalRecord& one, const GoalRecord& other) {
  if (one.request.priority != other.request.priority) return one.request.priority < other.request.priority;
  return one.arrival > other.arrival;
}

bool is_final(GoalState state) { return state != GoalState::pending && state != GoalState::planned; }

// Returns what keeps the request from being filled into its kind, which must be known and have these arguments.
std::string GoalSet::fault_of_form(const GoalRequest& request) const {
  const auto kind = mission_->goal_kinds.find(request.kind);
  if (kind == mission_->goal_kinds.end()) {
    return "unknown goal kind '" + request.kind + "'; this mission knows: " + keys_of(mission_->goal_kinds);
  }
  for (const auto& [name, argument] : kind->second.arguments) {
    const auto given = request.arguments.find(name);
    if (given == request.arguments.end())
      return "argument '" + name + "' is missing; a " + request.kind +
             " needs: " + keys_of(kind->second.arguments);
    if (argument == ArgumentKind::number && !is_number(given->second)) {
      return "argument '" + name + "' is '" + given->second + "'; expected a number";
    }
    if (argument == ArgumentKind::text && !is_name(given->second)) {
      return "argument '" + name + "' is '" + given->second + "'; use lower-case letters, digits, - and _";
    }
  }
  for (const auto& [name, value] : request.arguments) {
    if (!kind->second.arguments.contains(name)) {
      return "unknown argument '" + name + "'; a " + request.kind +
             " takes: " + keys_of(kind->second.arguments);
    }
  }
  return "";
}

std::string GoalSet::fault_of(const GoalRequest& request, temporal::Time now) const {
  if (std::string fault = fault_of_address(request); !fault.empty()) return fault;
  if (!is_name(request.key.id))
    return "id '" + request.key.id + "' is not a name; use lower-case letters, digits, - and _";
  if (std::string fault = fault_of_form(request); !fault.empty()) return fault;
  const GoalKind& kind = mission_->goal_kinds.at(request.kind);
  for (const auto& [name, argument] : kind.arguments) {
    if (argument == ArgumentKind::object) {
      std::string fault = fault_of_object(kind.object_types.at(name), request.arguments.at(name), name);
      if (!fault.empty()) return fault;
    }
    if (argument == ArgumentKind::goal) {
      std::string fault = fault_of_reference(request, name);
      if (!fault.empty()) return fault;
    }
  }
  for (const auto& [key, record] : records_) {
    if (key.id == request.key.id && key.issuer != request.key.issuer && record.state != GoalState::rejected) {
      return "id '" + key.id + "' is in use by issuer '" + key.issuer + "'; choose another id";
    }
  }
  if (!request.utility.finite()) return "utility is not a finite number; give one, e.g. 1";
  const bool has_window = request.opens.count() != 0 || request.closes.count() != 0;
  if (has_window && mission_->has_domain() && kind.window_fact.empty())
    return "a " + request.kind + " knows no window; leave 'opens' and 'closes' out, or give goal kind '" +
           request.kind + "' a 'window' in mission.yaml";
  if (request.closes.count() != 0 && request.closes <= std::max(request.opens, now)) {
    return "the window closes before it opens or has passed; give a later end";
  }
  return "";
}

std::string GoalSet::fault_of_object(const std::string& type, const std::string& given,
                                     const std::string& argument) const {
  const std::vector<std::string> known = objects_of_type(*mission_, type);
  if (std::ranges::find(known, given) != known.end()) return "";
  constexpr std::size_t kNamed = 20;
  std::string names;
  for (std::size_t i = 0; i < std::min(known.size(), kNamed); ++i) names += (i == 0 ? "" : ", ") + known[i];
  if (known.size() > kNamed) names += ", … (" + std::to_string(known.size()) + " in all)";
  return "argument '" + argument + "' is '" + given + "'; the mission has no such " + type +
         ", it has: " + (names.empty() ? "none" : names) + words::did_you_mean(given, known);
}

std::string GoalSet::fault_of_address(const GoalRequest& request) const {
  const mission::ExecutiveRole& role = mission_->role;
  if (addressee(role, request.robot) == mission::Addressee::this_one) return "";
  std::string known;
  for (const std::string& robot : role.commanded) known += (known.empty() ? "" : ", ") + robot;
  if (request.robot.empty()) return "it names no robot, and several are commanded: " + known + "; name one";
  return "no executive commands robot '" + request.robot +
         "'; name one of: " + (known.empty() ? role.robot : known);
}

// Checks an argument that names another goal and so stands for that goal's objects: those of this goal's
// facts that hold the argument must be among them.
std::string GoalSet::fault_of_reference(const GoalRequest& request, const std::string& argument) const {
  const GoalKind& kind = mission_->goal_kinds.at(request.kind);
  const std::string& id = request.arguments.at(argument);
  const std::string named = "argument '" + argument + "' names goal '" + id + "', ";
  const auto other = std::find_if(records_.begin(), records_.end(), [&](const auto& record) {
    return record.first.id == id && record.second.state != GoalState::rejected;
  });
  if (other == records_.end()) return named + "which is not known; send that goal first";
  const auto makes = [&](const GoalKind& maker, const std::string& object) {
    return std::any_of(maker.objects.begin(), maker.objects.end(), [&](const ObjectModel& model) {
      return fill_names(model.name, {{"id", id}}) == object;
    });
  };
  for (const std::string& fact : kind.goal) {
    for (const std::string& word : words_of(fact)) {
      const std::string object = fill_names(word, {{argument, id}});
      if (object == word || makes(mission_->goal_kinds.at(other->second.request.kind), object)) continue;
      std::string makers;
      for (const auto& [name, maker] : mission_->goal_kinds)
        if (makes(maker, object)) makers += (makers.empty() ? "" : ", ") + name;
      return named + "a " + other->second.request.kind + " without an object '" + object +
             "'; name a goal of kind: " + makers;
    }
  }
  return "";
}

bool GoalSet::names(const GoalRequest& request, const GoalRequest& other) const {
  const auto kind = mission_->goal_kinds.find(request.kind);
  if (kind == mission_->goal_kinds.end()) return false;
  return std::any_of(kind->second.arguments.begin(), kind->second.arguments.end(), [&](const auto& argument) {
    const auto given = request.arguments.find(argument.first);
    return argument.second == ArgumentKind::goal && given != request.arguments.end() &&
           given->second == other.key.id;
  });
}

std::vector<GoalRequest> GoalSet::in_reference_order(std::vector<GoalRequest> requests) const {
  for (auto at = requests.begin(); at != requests.end(); ++at) {
    // Finds the first from here on that names none of the others; in a cycle of names, the one that is
    // there.
    const auto free = std::find_if(at, requests.end(), [&](const GoalRequest& one) {
      return std::none_of(at, requests.end(),
                          [&](const GoalRequest& other) { return &other != &one && names(one, other); });
    });
    if (free != requests.end()) std::rotate(at, free, free + 1);
  }
  return requests;
}

GoalSet::Submission GoalSet::submit(const GoalRequest& request, temporal::Time now) {
  if (const auto found = records_.find(request.key); found != records_.end()) {
    GoalRecord& record = found->second;
    if (request.sample == record.answers && same_request(record.request, request))
      return {Disposition::known, &record};
    if (is_old(record, request)) return {Disposition::known, &record};
    const SampleId before = std::exchange(record.answers, request.sample);
    note_before(record, before);
    return {change(record, request, now), &record};
  }
  std::string fault = request.recalled ? "there is no such goal to recall" : fault_of(request, now);
  const bool good = fault.empty();
  GoalRecord& record = records_[request.key];
  record = {request,
            good ? GoalState::pending : GoalState::rejected,
            std::move(fault),
            next_arrival_++,
            0,
            request.sample,
            0,
            {}};
  return {good ? Disposition::accepted : Disposition::rejected, &record};
}

GoalSet::Disposition GoalSet::change(GoalRecord& record, const GoalRequest& request, temporal::Time now) {
  if (same_request(record.request, request)) return Disposition::repeated;
  if (request.recalled) {
    record.request.recalled = true;
    if (is_final(record.state)) return Disposition::repeated;
    record.state = GoalState::recalled;
    record.reason = "recalled by " + request.key.issuer;
    ++record.revision;
    return Disposition::recalled;
  }
  std::string fault = fault_of(request, now);
  if (record.state != GoalState::rejected && request.kind != record.request.kind)
    fault = "it is a " + record.request.kind + " and stays one; choose another id";
  if (!fault.empty()) {
    record.reason = "change refused: " + fault;
    return record.state == GoalState::rejected ? Disposition::rejected : Disposition::refused;
  }
  record.request = request;
  record.state = GoalState::pending;
  record.reason = "changed by " + request.key.issuer;
  ++record.revision;
  return Disposition::accepted;
}

const GoalRecord* GoalSet::merge(const GoalRecord& theirs) {
  const auto found = records_.find(theirs.request.key);
  if (found == records_.end()) {
    if (theirs.state == GoalState::rejected) return nullptr;
    // Its window may have closed meanwhile, which is no fault of the goal.
    std::string fault = fault_of(theirs.request, temporal::Time{0});
    GoalRecord& record = records_[theirs.request.key];
    record = theirs;
    record.arrival = next_arrival_++;
    record.plan_version = 0;
    if (!fault.empty()) {
      record.state = GoalState::rejected;
      record.reason = std::move(fault);
    } else if (!is_final(record.state)) {
      record.state = GoalState::pending;
    }
    return &record;
  }
  const auto changed = merged(found->second, theirs);
  if (!changed) return nullptr;
  if (!is_final(changed->state) && !fault_of(changed->request, temporal::Time{0}).empty()) return nullptr;
  found->second = *changed;
  return &found->second;
}

void GoalSet::restore(const GoalRecord& record) {
  GoalRecord& restored = records_.insert_or_assign(record.request.key, record).first->second;
  next_arrival_ = std::max(next_arrival_, record.arrival + 1);
  if (restored.state == GoalState::rejected) return;
  const std::string fault = fault_of_form(restored.request);
  if (fault.empty()) return;
  restored.state = GoalState::rejected;
  restored.reason = "it was taken once, and this mission cannot have it any more: " + fault;
}

void GoalSet::set_state(const GoalKey& key, GoalState state, std::string reason, std::uint32_t plan_version) {
  const auto record = records_.find(key);
  if (record == records_.end()) return;
  record->second.state = state;
  record->second.reason = std::move(reason);
  if (plan_version != 0) record->second.plan_version = plan_version;
}

std::vector<const GoalRecord*> GoalSet::all() const {
  std::vector<const GoalRecord*> out;
  for (const auto& [key, record] : records_) out.push_back(&record);
  std::sort(out.begin(), out.end(),
            [](const GoalRecord* a, const GoalRecord* b) { return a->arrival < b->arrival; });
  return out;
}

std::vector<const GoalRecord*> GoalSet::open() const {
  auto out = all();
  std::erase_if(out, [](const GoalRecord* record) { return is_final(record->state); });
  return out;
}

std::vector<const GoalRecord*> GoalSet::present() const {
  auto out = all();
  std::erase_if(out, [](const GoalRecord* record) { return record->state == GoalState::rejected; });
  return out;
}

const GoalRecord* GoalSet::find(const GoalKey& key) const {
  const auto record = records_.find(key);
  return record == records_.end() ? nullptr : &record->second;
}

std::optional<GoalKey> GoalSet::drop_candidate() const {
  std::vector<GoalKey> all_open;
  for (const GoalRecord* record : open()) all_open.push_back(record->request.key);
  return drop_candidate(all_open);
}

std::optional<GoalKey> GoalSet::drop_candidate(const std::vector<GoalKey>& among) const {
  const GoalRecord* opportunistic = nullptr;
  const GoalRecord* optional = nullptr;
  for (const GoalRecord* record : open()) {
    if (std::find(among.begin(), among.end(), record->request.key) == among.end()) continue;
    const GoalRequest& goal = record->request;
    if (goal.importance == GoalClass::opportunistic &&
        (opportunistic == nullptr || leaves_first(*record, *opportunistic)))
      opportunistic = record;
    if (goal.importance == GoalClass::optional &&
        (optional == nullptr || goal.utility < optional->request.utility ||
         (goal.utility <= optional->request.utility && leaves_first(*record, *optional))))
      optional = record;
  }
  if (opportunistic != nullptr) return opportunistic->request.key;
  if (optional != nullptr) return optional->request.key;
  return std::nullopt;
}

}  // namespace roci::exec::goals
