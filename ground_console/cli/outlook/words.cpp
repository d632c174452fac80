#include "ground_console/cli/outlook/words.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "ground_console/cli/mission_words.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::outlook {
namespace {

template <std::size_t N, class Enum>
const char* name_in(const std::array<const char*, N>& names, Enum value) {
  const auto index = static_cast<std::size_t>(value);
  return index < N ? names[index] : "unknown";
}

std::string three_digits(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), std::abs(value) >= 1000 ? "%.0f" : "%.3g", value);
  return buffer.data();
}

}  // namespace

const char* name_of(v1::DataTier tier) {
  return name_in(std::array{"critical", "decisional", "mandatory", "residual"}, tier);
}

const char* name_of(v1::ProductFate fate) {
  return name_in(std::array{"stored", "sent", "received", "discarded", "left behind", "lost"}, fate);
}

const char* name_of(v1::ChainStage stage) {
  return name_in(std::array{"planned", "committed", "running", "done", "failed"}, stage);
}

const char* name_of(v1::SignatureOutcome outcome) {
  return name_in(std::array{"unknown", "negative", "positive"}, outcome);
}

const char* colour_of(v1::DataTier tier) {
  return name_in(std::array{kRed, kOrange, kBlue, "#8a97a6"}, tier);
}

std::string bytes_text(std::uint64_t bytes) { return amount_text(static_cast<double>(bytes), "B"); }

std::string joules_text(double joules) { return amount_text(joules, "J"); }

std::string duration_text(double seconds) {
  if (seconds < 120) return three_digits(seconds) + " s";
  if (seconds < 7200) return three_digits(seconds / 60) + " min";
  return three_digits(seconds / 3600) + " h";
}

double seconds(std::int64_t us) { return static_cast<double>(us) / 1e6; }

template <class Sample>
std::string made_text(const Sample& sample) {
  return std::to_string(sample.version()) + (sample.robot().empty() ? "" : " of " + sample.robot()) +
         ", made at " + lib::clock_text(sample.made_us()) + " with plan " +
         std::to_string(sample.plan_version()) + " (network " + sample.network() + ", version " +
         std::to_string(sample.network_version()) + ")";
}
template std::string made_text(const v1::DownlinkSchedule&);
template std::string made_text(const v1::MissionOutlook&);

template <class Sample>
nlohmann::json made_json(const Sample& sample) {
  return {{"robot", sample.robot()},
          {"version", sample.version()},
          {"time_s", seconds(sample.made_us())},
          {"plan_version", sample.plan_version()},
          {"network", sample.network()},
          {"network_version", sample.network_version()},
          {"omitted", sample.omitted()}};
}
template nlohmann::json made_json(const v1::DownlinkSchedule&);
template nlohmann::json made_json(const v1::MissionOutlook&);

void draw_title(Svg& svg, const std::string& title, const std::string& subtitle) {
  svg.text(24, 30, title, {.size = 18, .colour = kText, .bold = true});
  svg.text(24, 49, subtitle, {.size = 11.5, .colour = kFaint});
}

std::vector<double> marks(double least, double most, int count) {
  const double whole = std::max(most - least, 1e-9);
  const double power = std::pow(10, std::floor(std::log10(whole / count)));
  double step = 10 * power;
  for (const double factor : {1, 2, 5})
    if (whole / (factor * power) <= count) {
      step = factor * power;
      break;
    }
  std::vector<double> out;
  for (double at = std::ceil(least / step - 1e-9) * step; at <= most + step * 1e-9; at += step)
    out.push_back(at + 0.0);  // never -0
  return out;
}

std::vector<double> time_marks(double from_s, double to_s, int count) {
  constexpr std::array kSteps{1.0,     5.0,      10.0,     30.0,     60.0,     300.0,
                              600.0,   1800.0,   3600.0,   7200.0,   21600.0,  43200.0,
                              86400.0, 172800.0, 259200.0, 345600.0, 432000.0, 864000.0};
  double step = kSteps.back();
  for (const double one : kSteps)
    if ((to_s - from_s) / one <= count) {
      step = one;
      break;
    }
  while ((to_s - from_s) / step > count) step *= 2;
  std::vector<double> out;
  for (double at = std::ceil(from_s / step) * step; at <= to_s; at += step) out.push_back(at);
  return out;
}

}  // namespace roci::console::cli::outlook
