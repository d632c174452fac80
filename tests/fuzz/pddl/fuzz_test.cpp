#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/pddl/check.hpp"
#include "core/pddl/parser.hpp"
#include "core/pddl/sexpr.hpp"
#include "tests/fuzz/pddl/mutate.hpp"
#include "tests/fuzz/pddl/target.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

std::vector<std::string> read_corpus() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(ROCI_SOURCE_DIR "/tests/fuzz/pddl/corpus")) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> corpus;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return corpus;
}

TEST(FuzzPddl, MutatedCorpusNeverCrashes) {
  const std::vector<std::string> corpus = read_corpus();
  ASSERT_GE(corpus.size(), 4u);
  std::mt19937_64 random(42);
  for (const std::string& text : corpus) run_all(text);
  for (int i = 0; i < rounds(8000); ++i) {
    const std::string& seed =
        corpus[std::uniform_int_distribution<std::size_t>(0, corpus.size() - 1)(random)];
    const std::string text = mutate(seed, corpus, random);
    ASSERT_NO_THROW(run_all(text)) << "iteration " << i << ":\n" << text;
  }
}

template <typename Parse>
bool parses(Parse parse, const std::string& text) {
  try {
    parse(text);
    return true;
  } catch (const pddl::ParseError&) {
    return false;
  }
}

TEST(FuzzPddl, ManyMutantsStillParse) {  // or the test above would only exercise the first error
  const std::vector<std::string> corpus = read_corpus();
  std::mt19937_64 random(43);
  int parsed = 0;
  for (int i = 0; i < 500; ++i) {
    for (const std::string& seed : corpus) {
      const std::string text = mutate(seed, corpus, random);
      const bool domain = parses([](const std::string& all) { pddl::parse_domain(all, "fuzz"); }, text);
      if (domain || parses([](const std::string& all) { pddl::parse_problem(all, "fuzz"); }, text)) ++parsed;
    }
  }
  EXPECT_GT(parsed, 100);
}

TEST(FuzzPddl, NoiseNeverCrashes) {
  std::mt19937_64 random(44);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (std::size_t length = random() % 200; length > 0; --length) text += static_cast<char>(random() % 256);
    ASSERT_NO_THROW(run_all(text));
  }
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

TEST(FuzzPddl, DeepestNestingIsHandledAndDeeperIsRefused) {
  const std::vector<std::string> openings = {"(not ", "(and ", "(forall (?x - t) ", "(imply (p) ",
                                             "(< 0 (+ 1 "};
  for (const std::string& open : openings) {
    const int parentheses = static_cast<int>(std::count(open.begin(), open.end(), '(')) -
                            static_cast<int>(std::count(open.begin(), open.end(), ')'));
    for (const int depth : {150, 195, 10000, 300000}) {
      run_all("(define (domain d) (:predicates (p)) (:action a :precondition " +
              repeated(open, depth / parentheses) + "(p)" +
              std::string(static_cast<std::size_t>(depth / parentheses * parentheses), ')') + "))");
      run_all("(define (domain d) (:predicates (p)) (:derived (p) " + repeated(open, depth / parentheses) +
              "(p)" + std::string(static_cast<std::size_t>(depth / parentheses * parentheses), ')') + "))");
      run_all("(define (problem x) (:domain d) (:init) (:goal " + repeated(open, depth / parentheses) +
              "(p)" + std::string(static_cast<std::size_t>(depth / parentheses * parentheses), ')') + "))");
    }
  }
  run_all(std::string(1'000'000, '('));
  run_all(std::string(1'000'000, ')'));
}

TEST(FuzzPddl, LongInputsAreHandled) {
  run_all("(define (domain d) (:predicates" + repeated(" (p ?x ?y - t)", 30000) + "))");
  run_all("(define (problem p) (:domain d) (:objects a1 - a) (:init" + repeated(" (q a1)", 100000) +
          ") (:goal (p)))");
  run_all(repeated("1: (act a1)\n", 300));
  run_all(std::string(2'000'000, 'x'));
}

// What is nested or chained deeper than it may be names the limit.
template <typename Load>
void expect_refused_by_limit(Load load, const std::string& words) {
  try {
    load();
    ADD_FAILURE() << "accepted";
  } catch (const pddl::ParseError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos)
        << std::string(error.what()).substr(0, 1000);
    EXPECT_LT(std::string(error.what()).size(), 200'000U);
  }
}

std::string numbered(const std::string& before, int from, int count, const std::string& after) {
  std::string all;
  for (int i = from; i < from + count; ++i) all += before + std::to_string(i) + after;
  return all;
}

TEST(FuzzPddl, DeepFormulasAreRefusedByTheLimit) {
  for (const std::string open : {"(not ", "(and ", "(when (p) ", "(forall (?x) ", "(or (p) ", "("}) {
    const std::string deep = repeated(open, 100'000) + "(p)" + std::string(100'000, ')');
    for (const std::string before : {"(:action a :precondition ", "(:action a :effect ", "(:derived (p) "}) {
      const std::string text = "(define (domain d) (:predicates (p)) " + before + deep + "))";
      expect_refused_by_limit([&] { pddl::load_domain(text, "fuzz"); }, "nested deeper than 200");
    }
  }
  expect_refused_by_limit([] { pddl::load_domain(std::string(1'000'000, '('), "fuzz"); },
                          "nested deeper than 200");
  expect_refused_by_limit([] { pddl::load_domain(std::string(1'000'000, ')'), "fuzz"); }, "')' without '('");
}

TEST(FuzzPddl, LongChainsOfTypesAreRefusedByTheLimit) {
  std::string chain;
  for (int i = 0; i < 100'000; ++i) chain += "t" + std::to_string(i) + " - t" + std::to_string(i + 1) + "\n";
  expect_refused_by_limit([&] { pddl::load_domain("(define (domain d) (:types " + chain + "))", "fuzz"); },
                          "more than 200 types above it");
  const std::string many = numbered(" t", 0, 20'000, "");
  run_all("(define (domain d) (:types" + many + " - u) (:predicates (p ?x - t1)))");
  expect_refused_by_limit(
      [&] { pddl::load_domain("(define (domain d) (:predicates (p ?x - (either" + many + "))))", "fuzz"); },
      "more than 200 types");
}

TEST(FuzzPddl, LongNamesAreRefusedByTheLimit) {
  const std::string name(1'000'000, 'n');
  expect_refused_by_limit(
      [&] { pddl::load_domain("(define (domain " + name + ") (:predicates (" + name + ")))", "fuzz"); },
      "more than 1000 characters");
  expect_refused_by_limit([&] { pddl::load_domain(name, "fuzz"); }, "more than 1000 characters");
}

// Each of these would take hours if its cost grew faster than its size.
TEST(FuzzPddl, WideInputsTakeTimeOfTheirSize) {
  run_all("(define (domain d) (:predicates (p)) (:functions (f)) (:action a :effect (increase (f) " +
          repeated("(/ 1 ", 180) + "(f)" + std::string(180, ')') + ")))");
  std::string rules = "(:derived (d0) (not (p)))";
  for (int i = 10'000; i > 0; --i)
    rules += "(:derived (d" + std::to_string(i) + ") (d" + std::to_string(i - 1) + "))";
  const std::string domain =
      "(define (domain d) (:predicates (p)" + numbered("(d", 0, 10'001, ")") + ")" + rules + ")";
  EXPECT_NO_THROW(pddl::load_domain(domain, "fuzz"));
  run_all("(define (domain d) (:predicates (p)) (:action a :precondition (forall (" +
          numbered("?x", 0, 5'000, " ") + ") (forall (" + numbered("?y", 0, 5'000, " ") + ") (p)))))");
  std::string unknown;
  for (int i = 0; i < 5'000; ++i) unknown += "(known" + std::to_string(i) + "x)";
  run_all("(define (domain d) (:predicates " + numbered("(known", 0, 5'000, ")") +
          ") (:action a :precondition (and " + unknown + ")))");
  run_all(repeated(",", 200'000) + "(define (domain d))");
  run_all("(define (problem x) (:domain d) (:init" + repeated(" ()", 50'000) + "))");
}

}  // namespace
}  // namespace roci::fuzz
