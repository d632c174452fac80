#include "dedicated_svc/method_run/method_run.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "dedicated_svc/methods/fill.hpp"

namespace roci::dedicated::method_run {
namespace {

using methods::Call;
using methods::Place;
using methods::Template;
using temporal::Value;

constexpr char kWrongValue[] = "wrong-value";

// Fills templates in place and remembers whether all were known.
class Filler {
 public:
  explicit Filler(std::function<std::optional<std::string>(const std::string&)> value_of)
      : value_of_(std::move(value_of)) {}

  void operator()(Template& text) {
    if (const auto filled = methods::fill(text, value_of_)) {
      text = *filled;
    } else {
      complete_ = false;
    }
  }
  void operator()(Place& place) {
    for (Template* part : {&place.object, &place.robot, &place.x, &place.y}) (*this)(*part);
  }
  void operator()(methods::CommandCall& call) {
    (*this)(call.robot);
    for (auto& [name, argument] : call.arguments) (*this)(argument);
  }
  void operator()(methods::PathCall& call) {
    (*this)(call.from);
    (*this)(call.to);
    (*this)(call.map_told_s);
  }
  void operator()(methods::TransformCall& call) {
    (*this)(call.place);
    (*this)(call.robot);
  }
  void operator()(methods::ObserveCall& call) {
    (*this)(call.timeline);
    (*this)(call.state);
    for (Template& argument : call.arguments) (*this)(argument);
  }
  void operator()(methods::WaitCall&) {}
  bool complete() const { return complete_; }

 private:
  std::function<std::optional<std::string>(const std::string&)> value_of_;
  bool complete_ = true;
};

std::optional<double> number_in(const std::map<std::string, Value>& values, const std::string& name) {
  const auto found = values.find(name);
  if (found == values.end()) return {};
  const double* number = std::get_if<double>(&found->second);
  return number ? std::optional(*number) : std::nullopt;
}

// Says in words which value is not right; empty: all are.
std::string fault_of(const Call& call, const std::map<std::string, Value>& values) {
  for (const auto& [name, range] : call.check) {
    const auto number = number_in(values, name);
    if (!number) return call.name + " brought no number '" + name + "'";
    if (!range.admits(*number)) return call.name + " brought " + name + " = " + to_argument(*number);
  }
  return {};
}

// By "call.error", by the error, or what counts for all others. Success is "done" and no error.
template <typename T>
const T* found_by(const std::map<std::string, T>& entries, const End& end) {
  for (const std::string& key : end.error.empty()
                                    ? std::vector<std::string>{"done"}
                                    : std::vector{end.call + "." + end.error, end.error, std::string("*")})
    if (const auto found = entries.find(key); found != entries.end()) return &found->second;
  return nullptr;
}

}  // namespace

std::string to_argument(const Value& value) {
  if (const double* number = std::get_if<double>(&value)) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, *number).ptr};
  }
  if (const auto* state = std::get_if<temporal::State>(&value)) return state->name;
  return temporal::to_text(value);
}

MethodRun::MethodRun(const methods::Method& method, std::map<std::string, std::string> arguments)
    : method_(&method), arguments_(std::move(arguments)), at_{&method.calls, 0} {}

Step MethodRun::begin() { return ask(); }

Step MethodRun::begin_after(const std::vector<Taken>& taken) {
  Step step = begin();
  for (const Taken& one : taken) {
    if (!step.ask) return {};
    step = take(one.answer, one.observed);
  }
  return step;
}

Observations MethodRun::needed(const Observations& observed) const {
  Observations out;
  for (const auto& [error, repair] : method_->repairs)
    for (const auto& [timeline, range] : repair.needs)
      if (const auto found = observed.find(timeline); found != observed.end()) out.insert(*found);
  return out;
}

Step MethodRun::ask() {
  auto call = filled(current());
  if (!call) return wrong_value(current().name + " needs a value that no call has brought", {});
  return {Ask{++number_, std::move(*call)}, {}, {}};
}

Step MethodRun::take(const Answer& answer, const Observations& observed) {
  if (std::holds_alternative<methods::CommandCall>(current().what)) {
    energy_known_ = energy_known_ && answer.energy_j;
    energy_j_ += answer.energy_j.value_or(0);
  }
  forget(current().name + ".");
  for (const auto& [name, value] : answer.values) values_[current().name + "." + name] = value;
  if (!answer.error.empty()) return fail(answer, observed);
  if (const std::string fault = fault_of(current(), answer.values); !fault.empty())
    return fail({kWrongValue, fault, answer.values, {}}, observed);
  return advance();
}

void MethodRun::forget(const std::string& front) {
  std::erase_if(values_, [&](const auto& value) { return value.first.starts_with(front); });
}

Step MethodRun::advance() {
  ++at_.index;
  if (at_.index < at_.calls->size()) return ask();
  if (go_on_) {
    at_ = {&method_->calls, *std::exchange(go_on_, std::nullopt)};
    if (at_.index < at_.calls->size()) return ask();
  }
  std::map<std::string, Value> results;
  for (const auto& [name, source] : method_->results) {
    const auto value = values_.find(source);
    if (value == values_.end()) return wrong_value("no call has brought the result '" + name + "'", {});
    results[name] = value->second;
  }
  return {{}, ended({}, {}, std::move(results)), {}};
}

Step MethodRun::wrong_value(const std::string& reason, std::map<std::string, Value> values) {
  return {{}, ended(kWrongValue, reason, std::move(values)), {}};
}

Step MethodRun::fail(const Answer& answer, const Observations& observed) {
  const std::string reason = current().name + ": " + (answer.reason.empty() ? answer.error : answer.reason);
  if (go_on_) {
    End end = error_;
    end.reason += "; its repair failed in " + reason;
    end.values = answer.values;
    end.energy_j = energy_j();
    return {{}, std::move(end), {}};
  }
  auto repair = method_->repairs.find(current().name + "." + answer.error);
  if (repair == method_->repairs.end()) repair = method_->repairs.find(answer.error);
  if (repair == method_->repairs.end() || repaired_[repair->first] >= repair->second.at_most ||
      !fits(repair->second, observed))
    return {{}, ended(answer.error, reason, answer.values), {}};
  ++repaired_[repair->first];
  const auto then = std::ranges::find(method_->calls, repair->second.then, &Call::name);
  go_on_ = repair->second.ends            ? method_->calls.size()
           : then == method_->calls.end() ? at_.index
                                          : static_cast<std::size_t>(then - method_->calls.begin());
  repair_ = &repair->second;
  at_ = {&repair_->calls, 0};
  error_ = ended(answer.error, reason, answer.values);
  Step step = ask();
  if (step.ask) step.repairing = reason;
  return step;
}

bool MethodRun::fits(const methods::Repair& repair, const Observations& observed) const {
  return std::ranges::all_of(repair.needs, [&](const auto& need) {
    const auto number = number_in(observed, need.first);
    return number && need.second.admits(*number);
  });
}

End MethodRun::forbid_repair() {
  error_.reason += "; there is no time to repair it";
  return error_;
}

End MethodRun::ended(std::string error, std::string reason, std::map<std::string, Value> values) const {
  return {std::move(error), std::move(reason), std::move(values), energy_j(),
          at_.index < at_.calls->size() ? current().name : std::string()};
}

std::optional<std::string> MethodRun::value_of(const std::string& name) const {
  if (const auto argument = arguments_.find(name); argument != arguments_.end()) return argument->second;
  if (const auto value = values_.find(name); value != values_.end()) return to_argument(value->second);
  return {};
}

std::optional<Call> MethodRun::filled(const Call& call) const {
  Call out = call;
  Filler fill([this](const std::string& name) { return value_of(name); });
  std::visit([&](auto& what) { fill(what); }, out.what);
  if (!fill.complete()) return {};
  return out;
}

Value MethodRun::shown(const methods::Shown& what) const {
  temporal::State state{what.name, what.arguments};
  Filler fill([this](const std::string& name) { return value_of(name).value_or(""); });
  for (std::string& argument : state.arguments) fill(argument);
  return state;
}

Value MethodRun::during() const {
  if (go_on_ && !repair_->shows.name.empty()) return shown(repair_->shows);
  if (!method_->during.name.empty()) return shown(method_->during);
  temporal::State state{method_->command, {}};
  for (const std::string& name : method_->arguments) state.arguments.push_back(arguments_.at(name));
  return state;
}

Value MethodRun::then(const methods::Shown& rest) const {
  return shown(method_->then.name.empty() ? rest : method_->then);
}

Value MethodRun::failed(const End& end, const methods::Shown& rest) const {
  const methods::Shown* found = found_by(method_->failed, end);
  return shown(found ? *found : rest);
}

std::map<std::string, Value> MethodRun::told(const End& end) const {
  std::map<std::string, Value> out;
  const auto* found = found_by(method_->tells, end);
  if (!found) return out;
  Filler fill([this](const std::string& name) { return value_of(name).value_or(""); });
  for (const auto& [name, state] : *found) {
    std::string timeline = name;
    fill(timeline);
    out.emplace(std::move(timeline), shown(state));
  }
  return out;
}

}  // namespace roci::dedicated::method_run
