#include "services/security/topic_rights.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "services/security/program_roles.hpp"
#include "services/topics/topics.hpp"

namespace roci::services::security {
namespace {

using enum Role;
using Roles = std::set<Role>;

constexpr std::pair<Role, std::string_view> kWords[] = {{service, "service"},
                                                        {master, "master"},
                                                        {executive, "executive"},
                                                        {planner, "planner"},
                                                        {path_planner, "path_planner"},
                                                        {arm_planner, "arm_planner"},
                                                        {functions, "functions"},
                                                        {analyst, "analyst"},
                                                        {listener, "listener"},
                                                        {owner, "owner"},
                                                        {commander, "commander"},
                                                        {world, "world"},
                                                        {resolver, "resolver"},
                                                        {launcher, "launcher"},
                                                        {console, "console"}};

template <class T>
TopicRights row(const topics::Topic<T>& topic, Roles writers, Roles readers) {
  return {topic.name, topic.scope, std::move(writers), std::move(readers)};
}

// Who serves writes the replies; who calls may cancel.
template <class Request, class Reply>
void add(std::vector<TopicRights>& rows, const topics::Procedure<Request, Reply>& procedure,
         const Roles& callers, const Roles& servers) {
  rows.push_back(row(procedure.request, callers, servers));
  rows.push_back(row(procedure.reply, servers, callers));
}

std::vector<TopicRights> make_table() {
  const Roles all{service, launcher, console};
  // clang-format off
  std::vector<TopicRights> rows{
      //  topic                  writers                                     readers
      row(topics::clock_ready,     {service},                                {master}),
      row(topics::clock_step,      {master},                                 all),
      row(topics::clock_done,      {service},                                {master}),
      row(topics::heartbeat,       {service},                                all),
      row(topics::time_probe,      {service},                                {service}),

      row(topics::exec_member,     {executive},                              {executive, console}),
      row(topics::exec_journal,    {executive},                              {executive}),
      row(topics::lease_request,   {executive},                              {owner}),
      row(topics::lease_state,     {owner},                                  {executive}),
      row(topics::goal_hand_over,  {executive},                              {executive}),

      row(topics::event,           all,                                      all),
      row(topics::goal,            {executive, analyst, world, console},     {executive, planner, listener, console}),
      row(topics::goal_status,     {executive},                              {planner, analyst, listener, console}),
      row(topics::command,         {executive, commander},                   {listener, owner, console}),
      row(topics::command_ack,     {owner},                                  {executive, planner, listener, commander, console}),
      row(topics::observation,     {owner, executive},                       {executive, planner, analyst, listener, commander, console}),
      row(topics::data_product,    {owner, analyst},                         {planner, analyst, listener, console}),
      row(topics::hazard,          {owner},                                  {path_planner, listener, console}),
      row(topics::plan,            {executive},                              {planner, listener, console}),
      row(topics::executed_plan,   {executive},                              {listener, console}),
      row(topics::step_status,     {executive},                              {planner, listener, console}),
      row(topics::mission_status,  {executive},                              {listener, world, launcher, console}),
      row(topics::function_offer,  {path_planner, arm_planner, functions},   {executive, planner, listener, console}),

      row(topics::order,           {console},                                {executive}),
      row(topics::order_status,    {executive},                              {console}),
      row(topics::decision,        {executive},                              {resolver, console}),
      row(topics::decision_answer, {resolver},                               {executive}),
      row(topics::decision_receipt,{executive},                              {resolver}),

      row(topics::network_order,   {world, console},                         {planner}),
      row(topics::network_status,  {planner},                                {console}),
      row(topics::downlink_schedule,{planner},                               {world, console}),
      row(topics::mission_outlook, {planner},                                {world, console}),

      row(topics::terrain_finding, {owner},                                  {path_planner, listener, console}),
      row(topics::map_patch,       {path_planner},                           {path_planner, listener, console}),
      row(topics::known_map,       {path_planner},                           {listener, console}),

      row(topics::plan_delta,      {planner},                                {executive}),
      row(topics::plan_receipt,    {executive},                              {planner}),
      row(topics::call_cancel,     {executive, planner, owner, console},     {planner, path_planner, arm_planner, functions}),
  };
  //        procedure                callers       servers
  add(rows, topics::plan_request,  {executive},  {planner});
  add(rows, topics::function_call, {planner},    {path_planner, arm_planner, functions});
  add(rows, topics::path_request,  {owner, console}, {path_planner});
  add(rows, topics::arm_motion,    {owner},      {arm_planner});
  // clang-format on
  return rows;
}

bool meet(const Roles& some, const Roles& others) {
  return std::ranges::any_of(some, [&](Role role) { return others.contains(role); });
}

std::vector<std::string> topics_for(const Roles& roles, transport::Scope scope, Roles TopicRights::*side) {
  std::vector<std::string> out;
  for (const TopicRights& rights : topic_rights())
    if (rights.scope == scope && meet(rights.*side, roles)) out.push_back(rights.topic);
  return out;
}

}  // namespace

std::string_view word_of(Role role) {
  return std::ranges::find(kWords, role, &std::pair<Role, std::string_view>::first)->second;
}

std::optional<Role> role_of(std::string_view word) {
  const auto* found = std::ranges::find(kWords, word, &std::pair<Role, std::string_view>::second);
  return found == std::end(kWords) ? std::nullopt : std::optional(found->first);
}

std::span<const TopicRights> topic_rights() {
  static const std::vector<TopicRights> table = make_table();
  return table;
}

std::set<Role> roles_of_program(std::string_view program) {
  const auto found = program_roles().find(program);
  if (found == program_roles().end()) return {};
  std::set<Role> out = found->second;
  out.insert(service);
  return out;
}

std::vector<std::string> writable(const std::set<Role>& roles, transport::Scope scope) {
  return topics_for(roles, scope, &TopicRights::writers);
}

std::vector<std::string> readable(const std::set<Role>& roles, transport::Scope scope) {
  return topics_for(roles, scope, &TopicRights::readers);
}

}  // namespace roci::services::security
