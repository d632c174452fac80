#include "exec_svc/trace/pattern.hpp"

#include <gtest/gtest.h>

namespace roci::exec::trace {
namespace {

TEST(PatternTest, GroupsAreReplacedFromLeftToRight) {
  EXPECT_EQ(Pattern("(a+)-(b+)").replaced("x aa-b a-bb y", "\\2/\\1"), "x b/aa bb/a y");
  EXPECT_EQ(Pattern("b").replaced("abab", "<\\0>"), "a<b>a<b>");
  EXPECT_EQ(Pattern("a").replaced("banana", ""), "bnn");
  EXPECT_EQ(Pattern("c").replaced("banana", "x"), "banana");
  EXPECT_EQ(Pattern("a").replaced("a", "\\\\n"), "\\n");
}

TEST(PatternTest, EndsOfTheTextMatchOnce) {
  EXPECT_EQ(Pattern("^a").replaced("aaa", "b"), "baa");
  EXPECT_EQ(Pattern("a$").replaced("aaa", "b"), "aab");
  EXPECT_EQ(Pattern("x*").replaced("ab", "-"), "-a-b-");
  EXPECT_EQ(Pattern("").replaced("", "-"), "-");
}

TEST(PatternTest, WhatIsNotValidIsSaid) {
  EXPECT_THROW(Pattern("(a"), PatternError);
  const Pattern one_group("(a)");
  EXPECT_NO_THROW(one_group.check_replacement("\\1\\0\\\\"));
  EXPECT_THROW(one_group.check_replacement("\\2"), PatternError);
  EXPECT_THROW(one_group.check_replacement("\\n"), PatternError);
  EXPECT_THROW(one_group.check_replacement("a\\"), PatternError);
}

// Plans are lines of tens of thousands of characters.
TEST(PatternTest, LongLinesAreSearchedToTheirEnd) {
  const std::string line = std::string(2'000'000, 'x') + " robot=rover";
  EXPECT_TRUE(Pattern("robot=[a-z]+$").found_in(line));
  EXPECT_EQ(Pattern(" (robot)=[a-z]+").replaced(line, "").size(), 2'000'000U);
}

}  // namespace
}  // namespace roci::exec::trace
