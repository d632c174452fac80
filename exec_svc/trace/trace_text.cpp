#include "exec_svc/trace/trace_text.hpp"

#include <charconv>
#include <istream>
#include <ostream>
#include <sstream>

namespace roci::exec::trace {
namespace {

constexpr std::string_view kFirstWord = "roci-trace";

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '\n') {
      out += "\\n";
    } else if (c == '\\') {
      out += "\\\\";
    } else {
      out += c;
    }
  }
  return out;
}

template <class T>
bool number(std::string_view text, T& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
}

/// Reads one text; it knows the place for its errors.
class Parser {
 public:
  Parser(std::istream& in, const std::string& name) : in_(in), name_(name) {}

  RecordedTrace parse() {
    first_line();
    for (std::string line; next(line);) trace_.lines.push_back(line_of(line));
    return std::move(trace_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw TraceError(name_ + ":" + std::to_string(at_) + ": " + what);
  }

  bool next(std::string& line) {
    ++at_;
    return static_cast<bool>(std::getline(in_, line));
  }

  void first_line() {
    std::string line;
    if (!next(line)) fail("the file is empty; write one with: roci-trace print RUN");
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != kFirstWord)
      fail("the first line is no 'roci-trace VERSION'; give a text that roci-trace print wrote");
    int version = 0;
    if (!(words >> word) || !number(std::string_view(word), version) || version < 1)
      fail("the first line names no version; write the trace again with: roci-trace print RUN");
    if (version > kTextFormat)
      fail("trace of format " + std::to_string(version) + ", this roci-trace reads up to " +
           std::to_string(kTextFormat) + "; read it with the version that wrote it");
    while (words >> word) take_property(word);
  }

  void take_property(const std::string& word) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    std::uint64_t seed = 0;
    if (name == "scenario") {
      trace_.scenario = value;
    } else if (name == "seed" && number(std::string_view(value), seed)) {
      trace_.seed = seed;
    } else if (name == "lines" && (value == "trace" || value == "all")) {
      trace_.decisions = value == "all";
    } else {
      fail("'" + word + "' is not known in a first line; known are scenario=, seed=, lines=trace, lines=all");
    }
  }

  Line line_of(const std::string& text) const {
    Line line;
    const std::size_t space = text.find(' ');
    std::int64_t microseconds = 0;
    if (space == std::string::npos || !number(std::string_view(text).substr(0, space), microseconds))
      fail("a line begins with its mission time in microseconds and a space; write the trace again");
    line.time = temporal::Time(microseconds);
    line.text = unescaped(std::string_view(text).substr(space + 1));
    line.number = at_ - 1;
    return line;
  }

  std::string unescaped(std::string_view text) const {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '\\') {
        out += text[i];
        continue;
      }
      const char next = ++i < text.size() ? text[i] : ' ';
      if (next != 'n' && next != '\\') fail("a backslash stands alone; write it as \\\\");
      out += next == 'n' ? '\n' : '\\';
    }
    return out;
  }

  std::istream& in_;
  const std::string& name_;
  std::size_t at_ = 0;  ///< The number of the line that was read last.
  RecordedTrace trace_;
};

}  // namespace

void print(std::ostream& out, const RecordedTrace& trace) {
  out << kFirstWord << ' ' << kTextFormat;
  if (!trace.scenario.empty()) out << " scenario=" << trace.scenario;
  if (trace.seed) out << " seed=" << *trace.seed;
  out << " lines=" << (trace.decisions ? "all" : "trace") << '\n';
  for (const Line& line : trace.lines) out << line.time.count() << ' ' << escaped(line.text) << '\n';
}

RecordedTrace parse(std::istream& in, const std::string& name) { return Parser(in, name).parse(); }

}  // namespace roci::exec::trace
