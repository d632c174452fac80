#include "core/pddl/sexpr.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/pddl/lexer.hpp"

namespace roci::pddl {

namespace {

// They stand in (define …) and nowhere else.
constexpr std::array<std::string_view, 17> kSections = {
    ":requirements", ":types",   ":constants",       ":predicates",  ":functions",
    ":modules",      ":derived", ":durative-action", ":constraints", ":process",
    ":event",        ":domain",  ":objects",         ":init",        ":goal",
    ":metric",       ":action"};
// They stand in (:action …) and (:durative-action …) and nowhere else.
constexpr std::array<std::string_view, 5> kFields = {":parameters", ":precondition", ":condition",
                                                     ":duration", ":effect"};

template <typename Words>
bool is_one_of(const Words& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

std::string describe(SourceLocation where) {
  return "line " + std::to_string(where.line) + ", column " + std::to_string(where.column);
}

// "(:action go" as it begins.
std::string beginning(const Sexpr& list) {
  std::string text = "(" + std::string(list.head());
  if (list.items.size() > 1 && !list.items[1].is_list && list.head().starts_with(':'))
    text += " " + list.items[1].word;
  return text;
}

class Reader {
 public:
  Reader(std::string_view text, std::string_view kind, DiagnosticLog& log)
      : lexer_(text, log), kind_(kind), log_(log) {}

  // Keeps the open lists on a stack of its own, so that hostile nesting meets the limit and not the machine's
  // stack.
  Sexpr read() {
    Token token = lexer_.next();
    for (; token.kind != Token::Kind::end; token = lexer_.next()) {
      if (token.kind == Token::Kind::open) {
        open(token);
      } else if (token.kind == Token::Kind::close) {
        close(token);
      } else {
        add_word(std::move(token));
      }
    }
    if (!open_.empty()) report_unclosed();
    while (!open_.empty()) close_innermost(token.where);
    if (lists_.empty() && log_.errors() == 0)
      log_.error(token.where, "empty input", "the file is one list: (define …)");
    if (lists_.empty()) log_.throw_errors();
    return definition();
  }

 private:
  struct Open {
    Sexpr list;
    bool first_in_line = false;
    int indentation = 0;
  };
  // A token that the indentation does not allow where it stands: `unclosed` should be closed before it.
  struct Misfit {
    SourceLocation where;
    SourceLocation unclosed;
  };

  void open(const Token& token) {
    if (open_.size() >= kMaxNesting) {
      log_.error(token.where, "parentheses are nested deeper than " + std::to_string(kMaxNesting),
                 "flatten the formula");
      log_.throw_errors();
    }
    if (open_.size() > 1 && !misfit_ && token.first_in_line && stands_before(token, open_.back()))
      misfit_ = Misfit{token.where, open_.back().list.where};
    Open list;
    list.list.is_list = true;
    list.list.where = token.where;
    list.first_in_line = token.first_in_line;
    list.indentation = token.indentation;
    open_.push_back(std::move(list));
  }

  // Whether a list at the beginning of its line stands further left than one that it is part of, or right below one that
  // has parts in its own line. Sections are often not indented at all.
  static bool stands_before(const Token& token, const Open& outer) {
    const Sexpr& list = outer.list;
    if (!outer.first_in_line || token.where.column > list.where.column) return false;
    if (token.where.column < list.where.column) return true;
    return list.items.size() > 1 && list.items[1].where.line == list.where.line &&
           !list.head().starts_with(':');
  }

  void close(const Token& token) {
    if (open_.empty()) return lists_.empty() ? report_early_close(token) : report_outside(token.where);
    if (open_.size() > 1 && !misfit_ && token.first_in_line && token.where.column < open_.back().indentation)
      misfit_ = Misfit{token.where, open_.back().list.where};
    close_innermost(token.where);
  }

  void close_innermost(SourceLocation where) {
    Sexpr done = std::move(open_.back().list);
    open_.pop_back();
    done.closed = where;
    (open_.empty() ? lists_ : open_.back().list.items).push_back(std::move(done));
  }

  void add_word(Token token) {
    if (open_.empty()) return report_outside(token.where);
    const bool is_head = open_.back().list.items.empty();
    if (is_head && is_one_of(kSections, token.word)) begin_section(token.word);
    if (open_.size() == 1 && is_one_of(kFields, token.word)) reopen_action(token);
    Sexpr word;
    word.word = std::move(token.word);
    word.where = token.where;
    open_.back().list.items.push_back(std::move(word));
  }

  // The innermost list turns out to be a section. Brings it to its place, right in (define …).
  void begin_section(const std::string& keyword) {
    if (open_.size() == 1) {
      reopen_definition(keyword);
    } else if (open_.size() > 2 && open_.front().list.head() == "define") {
      Open section = std::move(open_.back());
      open_.pop_back();
      const SourceLocation unclosed = misfit_ ? misfit_->unclosed : open_.back().list.where;
      const std::size_t missing = open_.size() - 1;
      log_.error(section.list.where,
                 "'(" + keyword + "' begins inside of '" + beginning(open_[1].list) + "' of line " +
                     std::to_string(open_[1].list.where.line) + ": " + std::to_string(missing) +
                     (missing == 1 ? " ')' is" : " ')' are") + " missing before it",
                 "look at the '(' in " + describe(unclosed));
      while (open_.size() > 1) close_innermost(section.list.where);
      open_.push_back(std::move(section));
    }
    misfit_.reset();
  }

  // A section behind the end of (define …): that was closed too early.
  void reopen_definition(const std::string& keyword) {
    if (lists_.empty() || lists_.back().head() != "define") return;
    const Sexpr& section = open_.front().list;
    log_.error(lists_.back().closed,
               "this ')' closes (define …), but '(" + keyword + "' follows in " + describe(section.where) +
                   ": one ')' too many before it",
               "take a ')' away");
    Open definition;
    definition.list = std::move(lists_.back());
    lists_.pop_back();
    open_.insert(open_.begin(), std::move(definition));
    outside_.reset();
  }

  // A field behind the end of its action: that was closed too early.
  void reopen_action(const Token& token) {
    auto& items = open_.back().list.items;
    if (items.empty() || !(items.back().head() == ":action" || items.back().head() == ":durative-action"))
      return;
    log_.error(items.back().closed,
               "this ')' closes '" + beginning(items.back()) + "', but its " + token.word + " follows in " +
                   describe(token.where) + ": one ')' too many before it",
               "take a ')' away");
    Open action;
    action.list = std::move(items.back());
    items.pop_back();
    open_.push_back(std::move(action));
  }

  void report_early_close(const Token& token) {
    if (!std::exchange(early_close_, true))
      log_.error(token.where, "')' without '('", "remove it or open the list");
  }

  void report_outside(SourceLocation where) {
    if (!lists_.empty()) {
      if (!outside_) outside_ = where;
    } else if (!std::exchange(early_text_, true)) {
      log_.error(where, "text outside of any parentheses", "the file is one list: (define …)");
    }
  }

  void report_unclosed() {
    const Sexpr& innermost = open_.back().list;
    if (misfit_) {
      log_.error(misfit_->where,
                 "by the indentation, the '(' in " + describe(misfit_->unclosed) +
                     " should be closed before this, and is not: a ')' is missing",
                 "close the '(' in line " + std::to_string(misfit_->unclosed.line));
    } else if (open_.size() == 1 && innermost.items.size() > 2 && innermost.items.back().is_list) {
      log_.error(innermost.items.back().closed,
                 "'" + beginning(innermost) + "' of line " + std::to_string(innermost.where.line) +
                     " is never closed: a ')' is missing at the end, or in its last section",
                 "add the missing ')'");
    } else {
      log_.error(innermost.where, "'(' is never closed", "add the missing ')'");
    }
  }

  Sexpr definition() {
    const auto wanted = std::ranges::find_if(lists_, [&](const Sexpr& list) {
      return list.head() == "define" && list.items.size() > 1 && list.items[1].head() == kind_;
    });
    const std::size_t chosen = wanted == lists_.end() ? 0 : static_cast<std::size_t>(wanted - lists_.begin());
    if (chosen > 0) {
      warn_outside(lists_.front().where, "before the definition");
    } else if (lists_.size() > 1 && (!outside_ || lists_[1].where < *outside_)) {
      outside_ = lists_[1].where;
    }
    if (outside_) warn_outside(*outside_, "after the end of the definition");
    return std::move(lists_[chosen]);
  }

  void warn_outside(SourceLocation where, const std::string& place) {
    log_.warn(Departure::outside_text, where, "text " + place + " is passed over",
              "one file holds one (define …)");
  }

  Lexer lexer_;
  std::string_view kind_;
  DiagnosticLog& log_;
  std::vector<Open> open_;
  std::vector<Sexpr> lists_;  // that are closed, beside one another
  std::optional<Misfit> misfit_;
  std::optional<SourceLocation> outside_;  // text behind the first list
  bool early_text_ = false;
  bool early_close_ = false;
};

}  // namespace

std::string_view Sexpr::head() const {
  return is_list && !items.empty() && !items.front().is_list ? std::string_view(items.front().word)
                                                             : std::string_view();
}

Sexpr read_sexpr(std::string_view text, std::string_view kind, DiagnosticLog& log) {
  return Reader(text, kind, log).read();
}

std::optional<double> as_number(std::string_view word) {
  std::string_view digits = word;
  if (!digits.empty() && (digits.front() == '+' || digits.front() == '-')) digits.remove_prefix(1);
  if (digits.empty() || !(digits.front() == '.' || (digits.front() >= '0' && digits.front() <= '9')))
    return {};
  const bool negative = word.front() == '-';
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) return {};
  return negative ? -value : value;
}

}  // namespace roci::pddl
