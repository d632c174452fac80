// docs/dds.md has one table of all topics. It is made here, from services/topics/topics.hpp, the rights of
// topic_rights.hpp and the keys of idl/, and compared with the page: a line that differs is printed as it should be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "services/security/topic_rights.hpp"
#include "services/topics/topics.hpp"

namespace roci::services::security {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAreArray;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// The @key members of each struct of idl/.
std::map<std::string, std::string> keys() {
  std::map<std::string, std::string> out;
  const std::regex one(R"(struct (\w+)|@key [\w ]+ (\w+);)");
  for (const auto& file : fs::directory_iterator(ROCI_SOURCE_DIR "/idl")) {
    if (file.path().extension() != ".idl") continue;
    const std::string text = text_of(file.path());
    std::string type;
    for (std::sregex_iterator found(text.begin(), text.end(), one), end; found != end; ++found) {
      if ((*found)[1].matched) type = (*found)[1];
      std::string& list = out[type];
      if ((*found)[2].matched) list += (list.empty() ? "" : ", ") + (*found)[2].str();
    }
  }
  return out;
}

std::string qos_text(transport::Qos qos) {
  switch (qos) {
    case transport::Qos::state:
      return "state";
    case transport::Qos::event:
      return "event";
    case transport::Qos::stream:
      return "stream";
    case transport::Qos::request:
      break;
  }
  return "request";
}

std::string partition_text(transport::Scope scope) {
  switch (scope) {
    case transport::Scope::everyone:
      return "none";
    case transport::Scope::team:
      return "`roci.team`";
    case transport::Scope::robot:
      break;
  }
  return "`roci.inner.R`";
}

std::string size_text(transport::PayloadLimit limit) {
  const std::size_t bytes = transport::bytes(limit);
  return bytes < (1 << 20) ? std::to_string(bytes >> 10) + " KiB" : std::to_string(bytes >> 20) + " MiB";
}

std::string words(const std::set<Role>& roles) {
  std::string text;
  for (const Role role : roles) text += (text.empty() ? "" : ", ") + std::string(word_of(role));
  return text;
}

class Table {
 public:
  template <class T>
  void add(const topics::Topic<T>& topic) {
    const std::string type = std::string(topic.type_name).substr(std::string("roci::v1::").size());
    const auto rights = std::ranges::find(topic_rights(), topic.name, &TopicRights::topic);
    const std::string& key = keys_.at(type);
    const bool clocked = topic.clocking == transport::Clocking::clocked;
    lines.push_back("| `" + std::string(topic.name) + "` | " + type + " | " + (key.empty() ? "–" : key) +
                    " | " + qos_text(topic.qos) + (clocked ? ", clocked" : "") + " | " +
                    partition_text(topic.scope) + " | " + size_text(topic.limit) + " | " +
                    words(rights->writers) + " | " + words(rights->readers) + " |");
  }
  template <class Request, class Reply>
  void add(const topics::Procedure<Request, Reply>& procedure) {
    add(procedure.request);
    add(procedure.reply);
  }

  std::vector<std::string> lines;

 private:
  const std::map<std::string, std::string> keys_ = keys();
};

template <class... Topics>
std::vector<std::string> table_of(const Topics&... all) {
  Table table;
  (table.add(all), ...);
  return table.lines;
}

TEST(TopicTable, OfThePageIsTheOneOfTheCode) {
  namespace t = topics;
  const std::vector<std::string> made = table_of(
      t::clock_ready, t::clock_step, t::clock_done, t::heartbeat, t::time_probe, t::exec_member,
      t::exec_journal, t::lease_request, t::lease_state, t::goal_hand_over, t::event, t::goal, t::goal_status,
      t::command, t::command_ack, t::observation, t::data_product, t::hazard, t::plan, t::executed_plan,
      t::step_status, t::mission_status, t::function_offer, t::order, t::order_status, t::decision,
      t::decision_answer, t::decision_receipt, t::network_order, t::network_status, t::downlink_schedule,
      t::mission_outlook, t::terrain_finding, t::map_patch, t::known_map, t::plan_delta, t::plan_receipt,
      t::call_cancel, t::plan_request, t::function_call, t::path_request, t::arm_motion);
  EXPECT_EQ(made.size(), topic_rights().size()) << "a topic of topics.hpp is missing in this test";
  std::vector<std::string> written;
  std::istringstream page(text_of(ROCI_SOURCE_DIR "/docs/dds.md"));
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `roci/")) written.push_back(line);
  std::string expected;
  for (const std::string& line : made) expected += line + "\n";
  EXPECT_THAT(written, ElementsAreArray(made)) << "docs/dds.md, \"All topics\", is to have these lines:\n"
                                               << expected;
}

}  // namespace
}  // namespace roci::services::security
