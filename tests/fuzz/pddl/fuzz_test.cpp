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
    parse(text, "fuzz");
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
      if (parses(pddl::parse_domain, text) || parses(pddl::parse_problem, text)) ++parsed;
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

}  // namespace
}  // namespace roci::fuzz
