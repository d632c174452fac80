#include "exec_svc/standby/standby_wire_service.hpp"

#include <unistd.h>

#include <array>

#include "exec_svc/goals/goal_fields.hpp"
#include "services/clock/wall.hpp"

namespace roci::exec::standby {

using goals::GoalRecord;
using journal::Position;

namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

v1::JournalPosition to_wire(const Position& position) {
  v1::JournalPosition out;
  out.epoch(position.epoch);
  out.commits(position.sequence);
  return out;
}

Position from_wire(const v1::JournalPosition& position) { return {position.epoch(), position.commits()}; }

}  // namespace

Moment moment() { return std::chrono::duration_cast<Moment>(services::clock::wall_now().time_since_epoch()); }

std::string name_of(Member member) { return member == Member::first ? "first" : "second"; }

Member member_of(const std::string& name) { return name == "second" ? Member::second : Member::first; }

v1::LeaseMessage to_wire(const LeaseMessage& message, const TransferProgress& arrival,
                         const std::string& executive) {
  v1::LeaseMessage out;
  out.executive(executive);
  out.member(name_of(message.member));
  out.exec_role(message.role == Role::leading ? v1::EXEC_LEADING : v1::EXEC_FOLLOWING);
  out.epoch(message.epoch);
  out.has(to_wire(message.has));
  out.receipt(to_wire(message.receipt));
  out.entitled(message.entitled);
  out.searching(message.searching);
  out.said_us(message.said.count());
  out.echo_us(message.echo.count());
  out.arriving(to_wire(arrival.at));
  out.arrived_parts(arrival.parts);
  out.host(host_name());
  out.process_id(getpid());
  return out;
}

LeaseMessage from_wire(const v1::LeaseMessage& in) {
  LeaseMessage out;
  out.member = member_of(in.member());
  out.role = in.exec_role() == v1::EXEC_LEADING ? Role::leading : Role::following;
  out.epoch = in.epoch();
  out.has = from_wire(in.has());
  out.receipt = from_wire(in.receipt());
  out.entitled = in.entitled();
  out.searching = in.searching();
  out.said = Moment(in.said_us());
  out.echo = Moment(in.echo_us());
  return out;
}

TransferProgress arrival_of(const v1::LeaseMessage& in) {
  return {from_wire(in.arriving()), in.arrived_parts()};
}

v1::LeaseRequest to_wire(const OwnerRequest& request, const std::string& commander) {
  v1::LeaseRequest out;
  out.commander(commander);
  out.member(name_of(request.member));
  out.epoch(request.epoch);
  out.wanted(request.wanted);
  out.leads(request.leads);
  out.term_us(request.term.count());
  out.said_us(request.said.count());
  return out;
}

LeaseReport from_wire(const v1::LeaseState& in) {
  LeaseReport out;
  out.owner = in.owner();
  if (!in.member().empty()) out.holder = member_of(in.member());
  out.epoch = in.epoch();
  out.newest_epoch = in.newest_epoch();
  out.echo = Moment(in.echo_us());
  out.term = Moment(in.term_us());
  return out;
}

v1::GoalHandOver to_wire(const GoalRecord& goal, const std::string& executive, Member member) {
  v1::GoalHandOver out;
  out.executive(executive);
  out.issuer(goal.request.key.issuer);
  out.id(goal.request.key.id);
  out.member(name_of(member));
  const std::string record = archive::to_bytes(goal);
  out.record().assign(record.begin(), record.end());
  return out;
}

std::optional<GoalRecord> from_wire(const v1::GoalHandOver& in) {
  try {
    auto out = archive::from_bytes<GoalRecord>(std::string(in.record().begin(), in.record().end()));
    const bool known = out.state >= goals::GoalState::rejected && out.state <= goals::GoalState::recalled &&
                       out.request.importance >= goals::GoalClass::hard &&
                       out.request.importance <= goals::GoalClass::opportunistic;
    if (!known || out.request.key != goals::GoalKey{in.issuer(), in.id()}) return std::nullopt;
    return out;
  } catch (const archive::ArchiveError&) {
    return std::nullopt;
  }
}

v1::JournalChunk to_wire(const Chunk& chunk, const std::string& executive) {
  v1::JournalChunk out;
  out.executive(executive);
  out.leader(chunk.leader);
  out.after(to_wire(chunk.after));
  out.reached(to_wire(chunk.at));
  out.part(chunk.part);
  out.parts(chunk.parts);
  out.checksum(chunk.checksum);
  out.changes().assign(chunk.bytes.begin(), chunk.bytes.end());
  return out;
}

Chunk from_wire(const v1::JournalChunk& in) {
  Chunk out;
  out.leader = in.leader();
  out.after = from_wire(in.after());
  out.at = from_wire(in.reached());
  out.part = in.part();
  out.parts = in.parts();
  out.checksum = in.checksum();
  out.bytes.assign(in.changes().begin(), in.changes().end());
  return out;
}

}  // namespace roci::exec::standby
