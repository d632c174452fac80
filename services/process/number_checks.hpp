// These checks say in words which numbers a command line cannot take; CLI11's own checks print their whole
// range.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace roci::services::process {

/// Returns the number, or nothing if the whole text is no finite number.
inline std::optional<double> number_in(const std::string& text) {
  double out = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, out);
  return error == std::errc() && at == end && std::isfinite(out) ? std::optional(out) : std::nullopt;
}

/// Accepts 0 and numbers above it.
inline CLI::Validator from_zero() {
  return {[](std::string& text) {
            const auto number = number_in(text);
            return number && *number >= 0 ? std::string() : "'" + text + "' is no number from 0 on";
          },
          "FROM 0"};
}

/// Accepts numbers above 0.
inline CLI::Validator above_zero() {
  return {[](std::string& text) {
            const auto number = number_in(text);
            return number && *number > 0 ? std::string() : "'" + text + "' is no number above 0";
          },
          "ABOVE 0"};
}

}  // namespace roci::services::process
