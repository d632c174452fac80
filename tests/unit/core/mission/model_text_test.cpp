// A model that consists of several files comes as one text, from which the files are read again.
#include "core/mission/model_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace roci::mission {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ModelText : public testing::Test {
 protected:
  ModelText() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "maps");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string text_of(const std::string& name) const {
    return model_text(Entry::parse("model: " + name + "\n", (folder_ / "mission.yaml").string()).at("model"));
  }
  std::string refusal(const std::string& name) const {
    try {
      text_of(name);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }
  static std::vector<std::string> names(const std::string& text) {
    std::vector<std::string> out;
    for (const ModelPart& part : model_parts(text, "model")) out.push_back(part.name);
    return out;
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / ("model_text_" + std::to_string(::getpid()));
};

TEST_F(ModelText, WhatIncludesNothingStaysAsItIs) {
  for (const std::string text :
       {"bore takes 60 s\n", "(define (domain d))", "", "include: [broken\n", "a: 1\n"}) {
    write("m", text);
    EXPECT_EQ(text_of("m"), text);
    ASSERT_EQ(model_parts(text, "model").size(), 1U);
    EXPECT_EQ(model_parts(text, "model")[0].text, text);
    EXPECT_EQ(model_parts(text, "model")[0].name, "model");
  }
}

TEST_F(ModelText, AllThatIsIncludedComesAlongOnceByItsName) {
  write("problem.yaml", "include: [domain.yaml, maps/yard.yaml]\nproblem: {}\n");
  write("domain.yaml", "include: maps/yard.yaml\ndomain: d");
  write("maps/yard.yaml", "include: [../domain.yaml, rocks.yaml]\n");
  write("maps/rocks.yaml", "");
  const std::string text = text_of("problem.yaml");
  EXPECT_THAT(names(text), ElementsAre("problem.yaml", "domain.yaml", "maps/yard.yaml", "maps/rocks.yaml"));
  EXPECT_EQ(model_parts(text, "model")[1].text, "include: maps/yard.yaml\ndomain: d\n");
  EXPECT_EQ(model_parts(text, "model")[3].text, "");
  std::filesystem::remove(folder_ / "domain.yaml");
  EXPECT_THAT(refusal("problem.yaml"), HasSubstr("problem.yaml:1:11: no file 'domain.yaml' beside this one"));
}

TEST_F(ModelText, FaultsAreToldAtTheirPlace) {
  EXPECT_THAT(refusal("nowhere.yaml"),
              HasSubstr("mission.yaml:1:8: cannot read model file 'nowhere.yaml'"));
  write("a.yaml", "include: b.yaml\n");
  write("b.yaml", "x: |\n--- # file: c.yaml\n");
  EXPECT_THAT(refusal("a.yaml"), HasSubstr("a.yaml:1:10: a file of the model has a line that begins with"));
  write("b.yaml", std::string(kMostModelBytes, '#'));
  EXPECT_THAT(refusal("a.yaml"), HasSubstr("the model has more than 8388608 bytes"));
  std::string many = "include: [";
  for (std::size_t i = 0; i <= kMostModelFiles; ++i) {
    write("f" + std::to_string(i), "");
    many += (i == 0 ? "f" : ", f") + std::to_string(i);
  }
  write("a.yaml", many + "]\n");
  EXPECT_THAT(refusal("a.yaml"), HasSubstr("more than 64 files make up one model"));
}

// What comes from the wire may be cut anywhere.
TEST_F(ModelText, ACutTextIsStillParted) {
  write("a.yaml", "include: b.yaml\n");
  write("b.yaml", "b: 1\n");
  const std::string text = text_of("a.yaml");
  for (std::size_t length = 0; length <= text.size(); ++length) {
    const auto parts = model_parts(text.substr(0, length), "model");
    std::size_t bytes = 0;
    for (const ModelPart& part : parts) bytes += part.text.size();
    EXPECT_LE(bytes, length);
    EXPECT_GE(parts.size(), 1U);
  }
}

}  // namespace
}  // namespace roci::mission
