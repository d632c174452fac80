#include "services/security/documents.hpp"

#include <ctime>

namespace roci::services::security {
namespace {

constexpr char kXml[] = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
// Cyclone DDS has no domain above 230.
constexpr char kEveryDomain[] = "<domains><id_range><min>0</min><max>230</max></id_range></domains>\n";
constexpr char kDate[] = "%Y-%m-%dT%H:%M:%SZ";

// Fast DDS reads it as local time and ignores the Z, so that it may be off by half a day.
std::string date_of(std::int64_t unix_s) {
  const std::time_t time = unix_s;
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, kDate, &utc);
  return text;
}

// Returns the text of the first element of this name; none where there is no such element.
std::optional<std::string> element(const std::string& xml, const std::string& name) {
  const std::string open = "<" + name + ">";
  const std::size_t begin = xml.find(open);
  const std::size_t end = xml.find("</" + name + ">");
  if (begin == std::string::npos || end == std::string::npos || end < begin + open.size()) return std::nullopt;
  return xml.substr(begin + open.size(), end - begin - open.size());
}

std::optional<std::int64_t> time_of(const std::optional<std::string>& date) {
  std::tm utc{};
  if (!date || strptime(date->c_str(), kDate, &utc) == nullptr) return std::nullopt;
  return timegm(&utc);
}

std::string criteria(const char* verb, const std::vector<std::string>& topics,
                     const std::vector<std::string>& partitions) {
  if (topics.empty()) return "";
  std::string text = std::string("<") + verb + "><topics>";
  for (const std::string& topic : topics) text += "<topic>" + topic + "</topic>";
  text += "</topics>";
  if (!partitions.empty()) {
    text += "<partitions>";
    for (const std::string& partition : partitions) text += "<partition>" + partition + "</partition>";
    text += "</partitions>";
  }
  return text + "</" + verb + ">\n";
}

// A rule for each scope: Fast DDS takes a partition that stands anywhere in a rule for one of all its topics.
std::string rule(const std::set<Role>& roles, transport::Scope scope, const std::string& robot) {
  const auto partitions = transport::partitions_of(scope, robot);
  const std::string rights = criteria("publish", writable(roles, scope), partitions) +
                             criteria("subscribe", readable(roles, scope), partitions);
  return rights.empty() ? "" : "<allow_rule>" + std::string(kEveryDomain) + rights + "</allow_rule>\n";
}

}  // namespace

std::string governance() {
  return std::string(kXml) + "<dds><domain_access_rules><domain_rule>\n" + kEveryDomain +
         "<allow_unauthenticated_participants>false</allow_unauthenticated_participants>\n"
         "<enable_join_access_control>true</enable_join_access_control>\n"
         "<discovery_protection_kind>ENCRYPT</discovery_protection_kind>\n"
         "<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>\n"
         "<rtps_protection_kind>ENCRYPT</rtps_protection_kind>\n"
         "<topic_access_rules><topic_rule>\n"
         "<topic_expression>*</topic_expression>\n"
         "<enable_discovery_protection>true</enable_discovery_protection>\n"
         "<enable_liveliness_protection>true</enable_liveliness_protection>\n"
         "<enable_read_access_control>true</enable_read_access_control>\n"
         "<enable_write_access_control>true</enable_write_access_control>\n"
         "<metadata_protection_kind>ENCRYPT</metadata_protection_kind>\n"
         "<data_protection_kind>NONE</data_protection_kind>\n"
         "</topic_rule></topic_access_rules>\n"
         "</domain_rule></domain_access_rules></dds>\n";
}

bool is_governance(const std::string& document) { return element(document, "domain_access_rules").has_value(); }

std::string permissions(const std::string& service, const std::string& subject, const std::set<Role>& roles,
                        const std::string& robot, const Validity& validity) {
  using transport::Scope;
  return std::string(kXml) + "<dds><permissions><grant name=\"" + service + "\">\n<subject_name>" + subject +
         "</subject_name>\n<validity><not_before>" + date_of(validity.begin) + "</not_before><not_after>" +
         date_of(validity.end) + "</not_after></validity>\n" + rule(roles, Scope::everyone, robot) +
         rule(roles, Scope::team, robot) + rule(roles, Scope::robot, robot) +
         "<default>DENY</default>\n</grant></permissions></dds>\n";
}

std::optional<Grant> grant_of(const std::string& permissions) {
  const auto subject = element(permissions, "subject_name");
  const auto begin = time_of(element(permissions, "not_before"));
  const auto end = time_of(element(permissions, "not_after"));
  if (!subject || !begin || !end) return std::nullopt;
  return Grant{*subject, {*begin, *end}};
}

}  // namespace roci::services::security
