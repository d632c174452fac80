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

std::string_view head_of(std::span<const Sexpr> items) {
  return items.empty() ? std::string_view() : items.front().word();
}

// "(:action go" as it begins.
std::string beginning(std::span<const Sexpr> items) {
  const std::string_view head = head_of(items);
  std::string text = "(" + std::string(head);
  if (items.size() > 1 && !items[1].is_list() && head.starts_with(':'))
    text += " " + std::string(items[1].word());
  return text;
}

class Reader {
 public:
  Reader(std::string_view text, std::string_view kind, DiagnosticLog& log)
      : tree_(text), lexer_(tree_.text(), log), kind_(kind), log_(log) {}

  // Keeps the open lists on a stack of its own, so that hostile nesting meets the limit and not the machine's
  // stack.
  SexprTree read() {
    Token token = lexer_.next();
    for (; token.kind != Token::Kind::end; token = lexer_.next()) {
      if (token.kind == Token::Kind::open) {
        open(token);
      } else if (token.kind == Token::Kind::close) {
        close(token);
      } else {
        add_word(token);
      }
    }
    if (!open_.empty()) report_unclosed();
    while (!open_.empty()) close_innermost(token.where);
    if (lists_.empty() && log_.errors() == 0)
      log_.error(token.where, "empty input", "the file is one list: (define …)");
    if (lists_.empty()) log_.throw_errors();
    tree_.set_root(definition());
    return std::move(tree_);
  }

 private:
  struct Open {
    SourceLocation where;
    std::size_t first = 0;  // of its parts in parts_
    bool first_in_line = false;
    int indentation = 0;
  };
  // A token that the indentation does not allow where it stands: `unclosed` should be closed before it.
  struct Misfit {
    SourceLocation where;
    SourceLocation unclosed;
  };

  // The parts that an open list has so far, without those that are open themselves.
  std::span<const Sexpr> parts(std::size_t open) const {
    const std::size_t end = open + 1 < open_.size() ? open_[open + 1].first : parts_.size();
    return std::span(parts_).subspan(open_[open].first, end - open_[open].first);
  }
  std::span<const Sexpr> innermost_parts() const { return std::span(parts_).subspan(open_.back().first); }

  void open(const Token& token) {
    if (open_.size() >= kMaxNesting) {
      log_.error(token.where, "parentheses are nested deeper than " + std::to_string(kMaxNesting),
                 "flatten the formula");
      log_.throw_errors();
    }
    if (open_.size() > 1 && !misfit_ && token.first_in_line && stands_before_innermost(token))
      misfit_ = Misfit{token.where, open_.back().where};
    open_.push_back({token.where, parts_.size(), token.first_in_line, token.indentation});
  }

  // Whether a list at the beginning of its line stands further left than one that it is part of, or right below one
  // that has parts in its own line. Sections are often not indented at all.
  bool stands_before_innermost(const Token& token) const {
    const Open& outer = open_.back();
    if (!outer.first_in_line || token.where.column > outer.where.column) return false;
    if (token.where.column < outer.where.column) return true;
    const std::span<const Sexpr> items = innermost_parts();
    return items.size() > 1 && items[1].where.line == outer.where.line && !head_of(items).starts_with(':');
  }

  void close(const Token& token) {
    if (open_.empty()) return lists_.empty() ? report_early_close(token) : report_outside(token.where);
    if (open_.size() > 1 && !misfit_ && token.first_in_line && token.where.column < open_.back().indentation)
      misfit_ = Misfit{token.where, open_.back().where};
    close_innermost(token.where);
  }

  void close_innermost(SourceLocation where) {
    const Open done = open_.back();
    open_.pop_back();
    const Sexpr list = Sexpr::list_at(tree_.keep(std::span(parts_).subspan(done.first)), done.where, where);
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(done.first), parts_.end());
    (open_.empty() ? lists_ : parts_).push_back(list);
  }

  void add_word(const Token& token) {
    if (open_.empty()) return report_outside(token.where);
    if (token.word.front() == ':') {
      const bool is_head = open_.back().first == parts_.size();
      if (is_head && is_one_of(kSections, token.word)) begin_section(token.word);
      if (open_.size() == 1 && is_one_of(kFields, token.word)) reopen_action(token);
    }
    parts_.push_back(Sexpr::word_at(token.word, token.where));
  }

  // The innermost list turns out to be a section, and has no parts yet. Brings it to its place, right in (define …).
  void begin_section(std::string_view keyword) {
    if (open_.size() == 1) {
      reopen_definition(keyword);
    } else if (open_.size() > 2 && head_of(parts(0)) == "define") {
      Open section = open_.back();
      open_.pop_back();
      const SourceLocation unclosed = misfit_ ? misfit_->unclosed : open_.back().where;
      const std::size_t missing = open_.size() - 1;
      log_.error(section.where,
                 "'(" + std::string(keyword) + "' begins inside of '" + beginning(parts(1)) + "' of line " +
                     std::to_string(open_[1].where.line) + ": " + std::to_string(missing) +
                     (missing == 1 ? " ')' is" : " ')' are") + " missing before it",
                 "look at the '(' in " + describe(unclosed));
      while (open_.size() > 1) close_innermost(section.where);
      section.first = parts_.size();
      open_.push_back(section);
    }
    misfit_.reset();
  }

  // A section behind the end of (define …): that was closed too early.
  void reopen_definition(std::string_view keyword) {
    if (lists_.empty() || lists_.back().head() != "define") return;
    const Open section = open_.front();
    const Sexpr definition = lists_.back();
    log_.error(definition.closed,
               "this ')' closes (define …), but '(" + std::string(keyword) + "' follows in " +
                   describe(section.where) + ": one ')' too many before it",
               "take a ')' away");
    lists_.pop_back();
    open_.clear();
    reopen(definition);
    open_.push_back(section);
    open_.back().first = parts_.size();
    outside_.reset();
  }

  // A field behind the end of its action: that was closed too early.
  void reopen_action(const Token& token) {
    if (innermost_parts().empty()) return;
    const Sexpr action = parts_.back();
    if (action.head() != ":action" && action.head() != ":durative-action") return;
    log_.error(action.closed,
               "this ')' closes '" + beginning(action.items()) + "', but its " + std::string(token.word) +
                   " follows in " + describe(token.where) + ": one ')' too many before it",
               "take a ')' away");
    parts_.pop_back();
    reopen(action);
  }

  void reopen(const Sexpr& list) {
    Open again;
    again.where = list.where;
    again.first = parts_.size();
    open_.push_back(again);
    parts_.insert(parts_.end(), list.items().begin(), list.items().end());
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
    const std::span<const Sexpr> items = innermost_parts();
    const SourceLocation where = open_.back().where;
    if (misfit_) {
      log_.error(misfit_->where,
                 "by the indentation, the '(' in " + describe(misfit_->unclosed) +
                     " should be closed before this, and is not: a ')' is missing",
                 "close the '(' in line " + std::to_string(misfit_->unclosed.line));
    } else if (open_.size() == 1 && items.size() > 2 && items.back().is_list()) {
      log_.error(items.back().closed,
                 "'" + beginning(items) + "' of line " + std::to_string(where.line) +
                     " is never closed: a ')' is missing at the end, or in its last section",
                 "add the missing ')'");
    } else {
      log_.error(where, "'(' is never closed", "add the missing ')'");
    }
  }

  const Sexpr& definition() {
    const auto wanted = std::ranges::find_if(lists_, [&](const Sexpr& list) {
      return list.head() == "define" && list.items().size() > 1 && list.items()[1].head() == kind_;
    });
    const std::size_t chosen = wanted == lists_.end() ? 0 : static_cast<std::size_t>(wanted - lists_.begin());
    if (chosen > 0) {
      warn_outside(lists_.front().where, "before the definition");
    } else if (lists_.size() > 1 && (!outside_ || lists_[1].where < *outside_)) {
      outside_ = lists_[1].where;
    }
    if (outside_) warn_outside(*outside_, "after the end of the definition");
    return lists_[chosen];
  }

  void warn_outside(SourceLocation where, const std::string& place) {
    log_.warn(Departure::outside_text, where, "text " + place + " is passed over",
              "one file holds one (define …)");
  }

  SexprTree tree_;
  Lexer lexer_;
  std::string_view kind_;
  DiagnosticLog& log_;
  std::vector<Open> open_;
  std::vector<Sexpr> parts_;  // of the open lists, one list behind the other
  std::vector<Sexpr> lists_;  // that are closed, beside one another
  std::optional<Misfit> misfit_;
  std::optional<SourceLocation> outside_;  // text behind the first list
  bool early_text_ = false;
  bool early_close_ = false;
};

}  // namespace

SexprTree::SexprTree(std::string_view text) : text_(text.size() + 1) {
  std::ranges::transform(text, text_.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
}

std::span<const Sexpr> SexprTree::keep(std::span<const Sexpr> items) {
  static constexpr std::size_t kBlock = 1024;
  if (blocks_.empty() || blocks_.back().capacity() - blocks_.back().size() < items.size()) {
    blocks_.emplace_back().reserve(std::max(kBlock, items.size()));
  }
  std::vector<Sexpr>& block = blocks_.back();
  const std::size_t first = block.size();
  block.insert(block.end(), items.begin(), items.end());
  return std::span(block).subspan(first);
}

SexprTree read_sexpr(std::string_view text, std::string_view kind, DiagnosticLog& log) {
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
