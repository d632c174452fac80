#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "planner_svc/timeline_htn/extraction/matrix.hpp"

namespace roci::planner::timeline_htn::extraction {

using temporal::Duration;

namespace {

std::string seconds(Duration time) {
  if (!temporal::bounded(time)) return "-";
  std::ostringstream out;
  out << temporal::to_seconds(time);
  return out.str();
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

bool is_last_of_value(const Matrix& matrix, std::size_t row, std::size_t column) {
  return column + 1 == matrix.transitions.size() || matrix.changes[row][column + 1];
}

}  // namespace

std::string to_text(const Matrix& matrix) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < matrix.timelines.size(); ++i) {
    std::size_t width = matrix.timelines[i].size();
    for (const auto& value : matrix.values[i]) width = std::max(width, temporal::to_text(value).size());
    widths.push_back(width + 2);
  }
  std::string out = padded("j", 5) + padded("earliest_s", 12) + padded("latest_s", 12);
  for (std::size_t i = 0; i < widths.size(); ++i) out += padded(matrix.timelines[i], widths[i]);
  out.erase(out.find_last_not_of(' ') + 1);
  out += '\n';
  for (std::size_t j = 0; j < matrix.transitions.size(); ++j) {
    std::string line = padded(std::to_string(j), 5) +
                       padded(seconds(matrix.transitions[j].window.lower), 12) +
                       padded(seconds(matrix.transitions[j].window.upper), 12);
    for (std::size_t i = 0; i < widths.size(); ++i)
      line += padded(matrix.changes[i][j] ? temporal::to_text(matrix.values[i][j]) : "|", widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out;
}

std::string to_json(const Matrix& matrix) {
  nlohmann::ordered_json out;
  out["timelines"] = matrix.timelines;
  out["transitions"] = nlohmann::ordered_json::array();
  for (const Transition& transition : matrix.transitions) {
    nlohmann::ordered_json one;
    one["earliest_s"] = temporal::to_seconds(transition.window.lower);
    one["latest_s"] = temporal::bounded(transition.window.upper)
                          ? nlohmann::ordered_json(temporal::to_seconds(transition.window.upper))
                          : nlohmann::ordered_json(nullptr);
    out["transitions"].push_back(one);
  }
  out["plan"] = nlohmann::ordered_json::array();
  for (const auto& row : matrix.values) {
    auto words = nlohmann::ordered_json::array();
    for (const auto& value : row)
      words.push_back(std::holds_alternative<std::monostate>(value)
                          ? nlohmann::ordered_json(nullptr)
                          : nlohmann::ordered_json(temporal::to_text(value)));
    out["plan"].push_back(std::move(words));
  }
  return out.dump(2);
}

std::string to_svg(const Matrix& matrix, const std::string& title) {
  constexpr int kLeft = 170, kTop = 70, kRow = 46, kColumn = 64;
  static constexpr const char* colours[] = {"#dbe9f6", "#fde8c8", "#dff0d8", "#f6dbe0", "#e6dff2", "#d9f0ee"};
  const int width = kLeft + kColumn * static_cast<int>(matrix.transitions.size()) + 20;
  const int height = kTop + kRow * static_cast<int>(matrix.timelines.size()) + 20;
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
      << "\" font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" "
         "fill=\"white\"/>\n"
      << "<text x=\"10\" y=\"20\" font-size=\"14\">" << escaped(title) << "</text>\n";
  for (std::size_t j = 0; j < matrix.transitions.size(); ++j) {
    const int x = kLeft + kColumn * static_cast<int>(j);
    out << "<text x=\"" << x << "\" y=\"40\">" << j << "</text><text x=\"" << x
        << "\" y=\"56\" fill=\"#666\">" << seconds(matrix.transitions[j].window.lower) << " s</text>\n";
    out << "<line x1=\"" << x << "\" y1=\"60\" x2=\"" << x << "\" y2=\"" << height - 10
        << "\" stroke=\"#ddd\"/>\n";
  }
  for (std::size_t i = 0; i < matrix.timelines.size(); ++i) {
    const int y = kTop + kRow * static_cast<int>(i);
    out << "<text x=\"10\" y=\"" << y + 22 << "\">" << escaped(matrix.timelines[i]) << "</text>\n";
    std::size_t from = 0;
    for (std::size_t j = 0; j < matrix.transitions.size(); ++j) {
      if (matrix.changes[i][j]) from = j;
      if (!is_last_of_value(matrix, i, j) || std::holds_alternative<std::monostate>(matrix.values[i][j]))
        continue;
      const std::string value = temporal::to_text(matrix.values[i][j]);
      const int x = kLeft + kColumn * static_cast<int>(from);
      const int wide = kColumn * static_cast<int>(j + 1 - from);
      const auto room = static_cast<std::size_t>(std::max(1, wide / 7));
      const std::string shown = value.size() <= room ? value : value.substr(0, room - 1) + "…";
      std::size_t hash = 0;
      for (const char c : value.substr(0, value.find('('))) hash = hash * 31 + static_cast<unsigned char>(c);
      out << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << wide - 2
          << "\" height=\"34\" rx=\"4\" fill=\"" << colours[hash % std::size(colours)]
          << "\" stroke=\"#888\"><title>" << escaped(value) << "</title></rect><text x=\"" << x + 4
          << "\" y=\"" << y + 21 << "\">" << escaped(shown) << "</text>\n";
    }
  }
  out << "</svg>\n";
  return out.str();
}

}  // namespace roci::planner::timeline_htn::extraction
