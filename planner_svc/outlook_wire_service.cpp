#include "planner_svc/outlook_wire_service.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "planner_svc/limits.hpp"

namespace roci::planner {
namespace {

// Keeps account of what a sample has taken: texts and, for each part, what it takes beside them.
class Room {
 public:
  // Returns whether a part has room; otherwise it is counted.
  bool take(std::size_t texts) {
    constexpr std::size_t kOfOnePart = 256;
    if (texts + kOfOnePart > left_) {
      ++omitted_;
      return false;
    }
    left_ -= texts + kOfOnePart;
    return true;
  }
  std::uint64_t omitted() const { return omitted_; }

 private:
  std::size_t left_ = kOutlookBytes;
  std::uint64_t omitted_ = 0;
};

v1::UtilityRank to_wire(const engine::UtilityRank& in) {
  v1::UtilityRank out;
  out.name(in.name);
  out.meaning(in.meaning);
  return out;
}

v1::ScheduledProduct to_wire(const engine::ScheduledProduct& in) {
  v1::ScheduledProduct out;
  out.id(in.id);
  out.exists(in.exists);
  out.bytes(in.bytes);
  out.tier(static_cast<v1::DataTier>(in.tier));
  return out;
}

v1::ScheduledDownlink to_wire(const engine::ScheduledDownlink& in, Room& room) {
  v1::ScheduledDownlink out;
  out.activity(in.activity);
  out.start_us(in.start.count());
  out.end_us(in.end.count());
  out.bytes(in.bytes);
  out.takes_us(in.takes.count());
  out.energy_j(in.energy_j);
  for (const engine::ScheduledProduct& one : in.products)
    if (room.take(one.id.size())) out.products().push_back(to_wire(one));
  return out;
}

std::vector<v1::UnsentProduct> to_wire(const std::vector<engine::UnsentProduct>& in, Room& room) {
  std::vector<v1::UnsentProduct> out;
  for (const engine::UnsentProduct& one : in) {
    if (!room.take(one.data.id.size() + std::min(one.why.size(), kReasonBytes))) continue;
    out.emplace_back().data(to_wire(one.data));
    out.back().why(one.why.substr(0, kReasonBytes));
  }
  return out;
}

v1::ChainOutlook to_wire(const engine::ChainOutlook& in) {
  v1::ChainOutlook out;
  out.request(in.request);
  out.title(in.title);
  out.chain(in.chain);
  out.block(in.block);
  out.stage(static_cast<v1::ChainStage>(in.stage));
  out.start_us(in.start.count());
  out.end_us(in.end.count());
  out.predicted(in.predicted.scores());
  out.executed(in.executed.scores());
  out.cost_j(in.cost_j);
  return out;
}

v1::ProductOutlook to_wire(const engine::ProductOutlook& in) {
  v1::ProductOutlook out;
  out.data(to_wire(in.data));
  out.request(in.request);
  out.fate(static_cast<v1::ProductFate>(in.fate));
  out.predicted(in.predicted.scores());
  out.executed(in.executed.scores());
  return out;
}

v1::EnergyPoint to_wire(const engine::EnergyPoint& in) {
  v1::EnergyPoint out;
  out.at_us(in.at.count());
  out.activity(in.activity);
  out.predicted_j(in.predicted_j);
  out.worst_j(in.worst_j);
  out.best_j(in.best_j);
  return out;
}

v1::SubwaySite to_wire(const engine::SubwaySite& in, Room& room) {
  v1::SubwaySite out;
  out.name(in.name);
  out.by_vision(in.by_vision);
  out.chance(in.chance);
  for (const engine::SubwayTarget& one : in.targets) {
    if (!room.take(one.task.size())) continue;
    v1::SubwayTarget& added = out.targets().emplace_back();
    added.task(one.task);
    added.outcome(static_cast<v1::SignatureOutcome>(one.outcome));
    added.visual(one.visual);
    added.estimated(one.estimated);
    added.planned(one.planned);
    added.closed(one.closed);
  }
  return out;
}

}  // namespace

v1::DownlinkSchedule to_wire(const engine::DownlinkSchedule& in) {
  v1::DownlinkSchedule out;
  Room room;
  for (const engine::UtilityRank& one : in.ranks)
    if (room.take(one.name.size() + one.meaning.size())) out.ranks().push_back(to_wire(one));
  out.limited(in.limited);
  for (const engine::ScheduledDownlink& one : in.downlinks)
    if (room.take(one.activity.size())) out.downlinks().push_back(to_wire(one, room));
  out.left_out(to_wire(in.left_out, room));
  out.late(to_wire(in.late, room));
  out.omitted(room.omitted());
  return out;
}

v1::MissionOutlook to_wire(const engine::MissionOutlook& in) {
  v1::MissionOutlook out;
  Room room;
  for (const engine::UtilityRank& one : in.ranks)
    if (room.take(one.name.size() + one.meaning.size())) out.ranks().push_back(to_wire(one));
  out.received(in.received.scores());
  out.budget(in.budget);
  out.capacity_j(in.capacity_j);
  out.most_samples(in.most_samples);
  out.next_target(in.next_target);
  for (const engine::SubwaySite& one : in.sites)
    if (room.take(one.name.size())) out.sites().push_back(to_wire(one, room));
  for (const engine::EnergyPoint& one : in.energy)
    if (room.take(one.activity.size())) out.energy().push_back(to_wire(one));
  for (const engine::ChainOutlook& one : in.chains)
    if (room.take(one.request.size() + one.title.size() + one.chain.size()))
      out.chains().push_back(to_wire(one));
  for (const engine::ProductOutlook& one : in.products)
    if (room.take(one.data.id.size() + one.request.size())) out.products().push_back(to_wire(one));
  out.omitted(room.omitted());
  return out;
}

}  // namespace roci::planner
