#include "services/owner/command_server.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "services/clock/wall.hpp"
#include "services/node/make_event.hpp"
#include "services/owner/command_wire.hpp"

namespace roci::services::owner {

namespace {

// The same words about a commander are told again after this time, and of so many at most.
constexpr temporal::Duration kAgain = std::chrono::seconds(60);
constexpr std::size_t kAnnounced = 256;

// Leases last in wall time, as processes die and links break in it.
CommanderLeases::Moment moment() {
  return std::chrono::duration_cast<CommanderLeases::Moment>(clock::wall_now().time_since_epoch());
}

// So many entries are appended to the file before it begins anew: many times those of the commands that are kept.
constexpr std::size_t kAppended = 10'000;

bool is_last_word(v1::CommandStage stage) {
  return stage != v1::STAGE_ACCEPTED && stage != v1::STAGE_CANCEL_FAILED;
}

}  // namespace

CommandServer::CommandServer(Node& node, Driver& driver)
    : node_(node),
      driver_(driver),
      acks_(advertise(node, topics::command_ack)),
      lease_states_(advertise(node, topics::lease_state)),
      events_(advertise(node, topics::event)) {
  subscribe(node, topics::command, [this](const v1::Command& command) {
    if (command.owner() == node_.options().name) receive(from_wire(command));
  });
  subscribe(node, topics::lease_request, [this](const v1::LeaseRequest& request) { receive(request); });
  node.on_peer_change([this](const health::PeerChange& change) {
    if (!change.alive) ledger_.release(change.service);
  });
}

bool CommandServer::keep_in(const std::filesystem::path& file, const std::optional<Resumed>& resumed) {
  file_.emplace(file);
  for (const LedgerEntry& entry : file_->read()) ledger_.restore(entry);
  const bool goes_on = resumed && ledger_.resume(resumed->request, resumed->accepted);
  ledger_.end_restored();
  begin_file_anew();
  return goes_on;
}

void CommandServer::say_again(const CommandKey& key) { send(ledger_.answer(key, node_.now())); }

/// A file that cannot be begun anew just goes on.
bool CommandServer::begin_file_anew() {
  try {
    file_->replace(ledger_.kept());
    unwritten_.clear();
    return true;
  } catch (const std::system_error& error) {
    announce({"ledger.unwritten", error.what()});
    return false;
  }
}

void CommandServer::keep() {
  std::vector<LedgerEntry> entries = ledger_.take_entries();
  if (!file_) return;
  unwritten_.insert(unwritten_.end(), entries.begin(), entries.end());
  if (file_->appended() + unwritten_.size() >= kAppended && begin_file_anew()) return;
  if (unwritten_.size() >= kAppended) {
    unwritten_.erase(unwritten_.begin(),
                     unwritten_.end() - kAppended);  // the file begins anew once the disk takes it
    return;
  }
  auto next = unwritten_.begin();
  try {
    for (; next != unwritten_.end(); ++next) file_->append(*next);
  } catch (const std::system_error& error) {
    announce({"ledger.unwritten", error.what()});  // a robot that can still be stopped beats one that cannot
  }
  unwritten_.erase(unwritten_.begin(), next);
}

void CommandServer::announce(const Notice& notice) {
  const std::string words = notice.code + " " + notice.text;
  const auto told = announced_.find(words);
  if (told != announced_.end() && node_.now() < told->second + kAgain) return;
  if (told == announced_.end() && announced_.size() >= kAnnounced) {
    std::erase_if(announced_, [this](const auto& one) { return node_.now() >= one.second + kAgain; });
    if (announced_.size() >= kAnnounced) return;
  }
  announced_[words] = node_.now();
  events_.write(node::make_event(v1::SEVERITY_WARNING, notice.code, notice.text));
}

void CommandServer::receive(const v1::LeaseRequest& request) {
  const std::uint64_t newest = ledger_.newest_epoch(request.commander());
  const LeaseGrant grant =
      leases_.ask({request.commander(), request.member(), request.epoch(), request.wanted(), request.leads(),
                   CommanderLeases::Moment(request.term_us()), CommanderLeases::Moment(request.said_us())},
                  newest, moment());
  v1::LeaseState state;
  state.owner(node_.options().name);
  state.commander(request.commander());
  state.member(grant.member);
  state.epoch(grant.epoch);
  state.newest_epoch(std::max(newest, leases_.newest_led(request.commander())));
  state.echo_us(grant.echo.count());
  state.term_us(grant.term.count());
  lease_states_.write(std::move(state));
}

/// Of the processes that command in one name. Who only asks changes nothing, and a stop is taken from anybody.
bool CommandServer::holds_lease(const Request& request) {
  const bool stops = request.action == Action::execute && request.command == kStopCommand;
  return leases_.admits(request.sender, request.epoch, moment()) || request.action == Action::query || stops;
}

void CommandServer::receive(const Request& request) {
  driver_.catch_up();
  if (!holds_lease(request)) {
    const LeaseGrant held = leases_.grant(request.sender, moment());
    send(ledger_.refuse_unleased(request, held.epoch, node_.now()));
    return;
  }
  if (request.action == Action::query) driver_.asked_about(request.key);
  const Reception reception = ledger_.receive(request, node_.now());
  if (reception.notice) announce(*reception.notice);
  send(reception.ack);
  switch (reception.order) {
    case Reception::Order::nothing:
      return;
    case Reception::Order::break_off:
      return driver_.break_off(request.key, {Stage::cancelled, "cancelled", "cancelled on request"});
    case Reception::Order::carry_out:
      break;
  }
  if (request.command == kLeadCommand) {
    say(request.key, {Stage::completed, "done", ""});
    return;
  }
  if (request.command == kStopCommand && !driver_stops_) return stop(request);
  driver_.carry_out(request);
}

void CommandServer::stop(const Request& request) {
  for (const CommandKey& key : ledger_.open(request.robot, request.subsystem)) {
    if (key == request.key) continue;
    driver_.break_off(key, {Stage::cancelled, "stopped", "stopped by " + request.key.activity});
  }
  say(request.key, {Stage::completed, "done", ""});
}

bool CommandServer::say(const CommandKey& key, CommandStatus status) {
  return send(ledger_.say(key, std::move(status), node_.now()));
}

bool CommandServer::refuse_cancel(const CommandKey& key, std::string reason) {
  return send(ledger_.refuse_cancel(key, std::move(reason), node_.now()));
}

bool CommandServer::repair(const CommandKey& key, std::string reason) {
  const bool allowed = send(ledger_.repair(key, std::move(reason), node_.now()));
  watch_overruns();
  return allowed;
}

bool CommandServer::send(const std::optional<Ack>& ack) {
  keep();
  if (ack) {
    const v1::CommandAck sample = to_wire(*ack, node_.options().name);
    acks_.write(sample);
    if (is_last_word(sample.stage())) acks_.dispose(sample);  // who still asks for it sends a query
  }
  return ack.has_value();
}

void CommandServer::watch_overruns() {
  if (overrun_) node_.cancel(*std::exchange(overrun_, std::nullopt));
  const auto next = ledger_.next_overrun();
  if (!next) return;
  overrun_ = node_.at(*next, [this] {
    overrun_.reset();
    for (const CommandKey& key : ledger_.take_overruns(node_.now())) {
      const CommandStatus why{Stage::failed, "repair-overrun",
                              "the step's time was over before the repair was"};
      driver_.break_off(key, why);
    }
    watch_overruns();
  });
}

}  // namespace roci::services::owner
