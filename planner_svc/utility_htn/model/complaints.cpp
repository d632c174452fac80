#include "planner_svc/utility_htn/model/complaints.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>

#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"

namespace roci::planner::utility_htn::model {

using temporal::timelines::Kind;

namespace {

bool is_name(std::string_view text) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const auto other = [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
  };
  return !text.empty() && letter(text.front()) &&
         std::ranges::all_of(text, [&](char c) { return letter(c) || other(c); });
}

// Returns the length of the UTF-8 sequence at the front, 0 if there is none or it is a control character.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : byte(0) >= 0xc2 ? 2 : 0;
  if (length == 0 || byte(0) > 0xf4 || text.size() < length) return 0;
  char32_t code = byte(0) & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return 0;
    code = code << 6U | (byte(i) & 0x3fU);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool unprintable = code < 0xa0 || (code >= 0xd800 && code < 0xe000) || code > 0x10ffff ||
                           code == 0xfeff || (code & 0xfffeU) == 0xfffe || code == 0x2028 || code == 0x2029;
  return overlong || unprintable ? 0 : length;
}

bool is_text(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

// So much of a text that may hold anything as can be shown.
std::string shown(std::string text) {
  if (text.size() > 60) text = text.substr(0, 60) + "…";
  return is_text(text) ? "'" + text + "'" : "that cannot be shown";
}

}  // namespace

void Complaints::name(const std::string& kind, const std::string& text) {
  if (text.empty()) {
    error(kind + " is empty", "give it a name");
  } else if (!is_name(text)) {
    error(kind + " " + shown(text) + " is no name",
          "use letters, digits, '_', '.' and '-', with a letter or '_' at the front");
  } else if (text.size() > kLongestText) {
    error(kind + " " + shown(text) + " is longer than " + std::to_string(kLongestText) + " bytes",
          "shorten it");
  }
}

void Complaints::text(const std::string& kind, const std::string& text) {
  if (text.size() > kLongestText) {
    error(kind + " " + shown(text) + " is longer than " + std::to_string(kLongestText) + " bytes",
          "shorten it");
  } else if (!is_text(text)) {
    error(kind + " holds control characters or is no UTF-8", "write it as plain text in one line");
  }
}

void Complaints::more_than(const std::string& kind, std::size_t count, std::size_t most) {
  if (count > most)
    error(std::to_string(count) + " " + kind + " do not fit: at most " + std::to_string(most),
          "make the network smaller");
}

void Complaints::constraint(const std::string& kind, const temporal::timelines::Constraint& constraint) {
  if (constraint.timeline >= network.timelines.size())
    return error(kind + " names timeline number " + std::to_string(constraint.timeline) + " of " +
                 std::to_string(network.timelines.size()));
  const auto& timeline = network.timelines[constraint.timeline];
  const bool bounded = constraint.lowest > -std::numeric_limits<double>::infinity() ||
                       constraint.highest < std::numeric_limits<double>::infinity();
  if (timeline.kind == Kind::state) {
    const std::uint64_t declared =
        timeline.states.size() >= 64 ? ~0ULL : (1ULL << timeline.states.size()) - 1;
    if (bounded)
      error(kind + " compares '" + timeline.name + "', which has named states, with a number",
            "name one of its states");
    else if (constraint.states == 0 || (constraint.states & ~declared) != 0)
      error(kind + " permits no state of '" + timeline.name + "', or one that it does not have",
            "name one of its states");
    return;
  }
  if (constraint.states != 0)
    return error(kind + " asks for a state of '" + timeline.name + "', whose values are numbers",
                 "compare it with a number");
  if (std::isnan(constraint.lowest) || std::isnan(constraint.highest) ||
      constraint.lowest > constraint.highest)
    return error(
        kind + " on '" + timeline.name + "' permits no value: its lower bound is above the upper one",
        "exchange the bounds");
  if (constraint.lowest > timeline.highest || constraint.highest < timeline.lowest)
    error(kind + " '" + to_text(constraint, network) + "' never holds: the range of '" + timeline.name +
              "' is " + to_text(timeline.lowest) + " .. " + to_text(timeline.highest),
          "mend the bound or the range");
}

void Complaints::amount(const std::string& kind, const Amount& amount, double lowest, double highest) {
  if (!amount.parameter) {
    if (!std::isfinite(amount.constant) || amount.constant < lowest || amount.constant > highest)
      error(kind + " is " + to_text(amount.constant) + ", which is not within " + to_text(lowest) + " .. " +
                to_text(highest),
            "mend the number");
    return;
  }
  if (*amount.parameter >= network.parameters.size())
    return error(kind + " names parameter number " + std::to_string(*amount.parameter) + " of " +
                 std::to_string(network.parameters.size()));
  const Parameter& parameter = network.parameters[*amount.parameter];
  const auto at = [&](double value) { return amount.constant + amount.factor * value; };
  const auto within = [&](double value) {
    return std::isfinite(value) && value >= lowest && value <= highest;
  };
  if (!std::isfinite(amount.factor) || !within(at(parameter.prior)))
    return error(kind + " is " + to_text(at(parameter.prior)) + " with the prior of '" + parameter.name +
                     "', which is not within " + to_text(lowest) + " .. " + to_text(highest),
                 "mend the number or the parameter's value");
  if (!within(at(parameter.lowest)) || !within(at(parameter.highest)))
    error(kind + " can leave " + to_text(lowest) + " .. " + to_text(highest) + ", since the range of '" +
              parameter.name + "' is " + to_text(parameter.lowest) + " .. " + to_text(parameter.highest),
          "narrow the parameter's range");
}

}  // namespace roci::planner::utility_htn::model
