#include "core/mission/entry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace roci::mission {
namespace {

using testing::HasSubstr;

class EntryTest : public testing::Test {
 protected:
  Entry parse(const std::string& text) {
    file_ = std::filesystem::temp_directory_path() /
            (std::string("roci_entry_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml");
    std::ofstream(file_) << text;
    return Entry::load(file_);
  }
  template <class F>
  std::string error_of(F&& read) {
    try {
      read();
    } catch (const FileError& error) {
      return error.what();
    }
    return "no error";
  }
  void TearDown() override { std::filesystem::remove(file_); }
  std::filesystem::path file_;
};

TEST_F(EntryTest, ReadsValuesInFileOrder) {
  const Entry root = parse("b: 2.5\na: [x, y]\nc: {t: true, n: 7}\n");
  EXPECT_DOUBLE_EQ(root.at("b").number(), 2.5);
  EXPECT_THAT(root.at("a").texts(), testing::ElementsAre("x", "y"));
  EXPECT_TRUE(root.at("c").at("t").truth());
  EXPECT_EQ(root.at("c").at("n").integer(), 7);
  EXPECT_EQ(root.fields().front().first, "b");
  EXPECT_FALSE(root.find("d"));
}

TEST_F(EntryTest, MissingKeyNamesPlaceAndKey) {
  const Entry root = parse("x: 1\nrover:\n  speed: 2\n");
  EXPECT_THAT(error_of([&] { root.at("rover").at("mass"); }), HasSubstr(file_.string() + ":3:3: 'mass' is missing"));
}

TEST_F(EntryTest, WrongKindNamesTheValue) {
  const Entry root = parse("speed: fast\n");
  EXPECT_THAT(error_of([&] { root.at("speed").number(); }), HasSubstr(":1:8: expected a finite number, not 'fast'"));
  EXPECT_THAT(error_of([&] { root.at("speed").items(); }), HasSubstr("expected a list"));
  EXPECT_THAT(error_of([&] { root.at("speed").at("x"); }), HasSubstr("expected 'key: value' pairs"));
}

TEST_F(EntryTest, InfinityIsNoNumber) {
  const Entry root = parse("speed: .inf\n");
  EXPECT_THAT(error_of([&] { root.at("speed").number(); }), HasSubstr("finite"));
}

TEST_F(EntryTest, UnknownKeyListsTheKnownOnes) {
  const Entry root = parse("name: a\nspede: 1\n");
  EXPECT_THAT(error_of([&] { root.allow_only({"name", "speed"}); }), HasSubstr(":2:1: unknown key 'spede'; known here: name, speed"));
}

TEST_F(EntryTest, SyntaxErrorsAndMissingFiles) {
  EXPECT_THAT(error_of([&] { parse("a: [1, 2\nb: 3\n"); }), HasSubstr("not valid YAML"));
  EXPECT_THAT(error_of([&] { parse("just words\n"); }), HasSubstr(":1:1:"));
  EXPECT_THAT(error_of([] { Entry::load("/nonexistent/m.yaml"); }), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace roci::mission
