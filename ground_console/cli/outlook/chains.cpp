// A whole mission over time: what was done of each request and what is planned (figure 8).
#include <algorithm>
#include <nlohmann/json.hpp>

#include "ground_console/cli/outlook/outlook.hpp"
#include "ground_console/cli/outlook/words.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::outlook {
namespace {

using nlohmann::json;

constexpr double kTimes = 200;     // where the time axis begins
constexpr double kTimeAxis = 900;  // its length
constexpr double kLane = 22;

// "sample_1_0" is one of "sample": requests whose names differ in numbers at the end share a row.
std::string kind_of(const std::string& request) {
  std::string out = request;
  for (;;) {
    const std::size_t mark = out.rfind('_');
    if (mark == std::string::npos || mark == 0 || mark + 1 == out.size()) return out;
    const bool digits = std::all_of(out.begin() + static_cast<std::ptrdiff_t>(mark) + 1, out.end(),
                                    [](unsigned char c) { return c >= '0' && c <= '9'; });
    if (!digits) return out;
    out.resize(mark);
  }
}

struct KindRow {
  std::string kind;
  std::vector<const v1::ChainOutlook*> chains;  // by start
  std::vector<std::size_t> lane;                // of each
  std::size_t lanes = 1;
};

// By their first starts. Of a row whose chains overlap each goes into the first lane that is free.
std::vector<KindRow> rows_of(const v1::MissionOutlook& outlook) {
  std::vector<const v1::ChainOutlook*> chains;
  for (const v1::ChainOutlook& one : outlook.chains()) chains.push_back(&one);
  std::ranges::stable_sort(chains, {}, [](const auto* one) { return one->start_us(); });
  std::vector<KindRow> out;
  std::vector<std::vector<std::int64_t>> free_from;  // by row and lane
  for (const v1::ChainOutlook* const one : chains) {
    const std::string kind = kind_of(one->request());
    auto row = std::ranges::find(out, kind, &KindRow::kind);
    if (row == out.end()) {
      if (out.size() == kMostRows) continue;
      row = out.insert(out.end(), KindRow{kind, {}, {}});
      free_from.emplace_back();
    }
    std::vector<std::int64_t>& lanes = free_from[static_cast<std::size_t>(row - out.begin())];
    auto lane = std::ranges::find_if(lanes, [&](std::int64_t time) { return time <= one->start_us(); });
    constexpr std::size_t kMostLanes = 12;
    if (lane == lanes.end() && lanes.size() < kMostLanes) lane = lanes.insert(lanes.end(), 0);
    if (lane == lanes.end()) lane = std::prev(lane);
    *lane = std::max(one->start_us(), one->end_us());
    row->chains.push_back(one);
    row->lane.push_back(static_cast<std::size_t>(lane - lanes.begin()));
    row->lanes = lanes.size();
  }
  return out;
}

Ink ink_of(v1::ChainStage stage) {
  switch (stage) {
    case v1::CHAIN_DONE:
      return {.fill = kGreen};
    case v1::CHAIN_FAILED:
      return {.fill = kRed};
    case v1::CHAIN_RUNNING:
      return {.fill = kBlue};
    case v1::CHAIN_COMMITTED:
      return {.fill = kPaleBlue, .stroke = kBlue};
    case v1::CHAIN_PLANNED:
      break;
  }
  return {.fill = "white", .stroke = kBlue};
}

class Mission {
 public:
  explicit Mission(const v1::MissionOutlook& outlook) : outlook_(outlook), rows_(rows_of(outlook)) {
    from_s_ = to_s_ = seconds(outlook.made_us());
    for (const v1::ChainOutlook& one : outlook.chains()) {
      from_s_ = std::min(from_s_, seconds(one.start_us()));
      to_s_ = std::max(to_s_, seconds(one.end_us()));
    }
    to_s_ = std::max(to_s_, from_s_ + 1);
  }

  std::string draw() {
    draw_title(svg_, "The mission, done and planned", "Outlook " + made_text(outlook_));
    draw_key();
    const double upper = kTop + 42;
    double y = upper;
    for (const KindRow& row : rows_) y += static_cast<double>(row.lanes) * kLane + 8;
    draw_axis(upper, y);
    y = upper;
    for (const KindRow& row : rows_) y = draw_row(row, y);
    const double now = x_of(seconds(outlook_.made_us()));
    svg_.line({now, upper - 8}, {now, y}, {.stroke = kText, .width = 1.5, .dashes = "4 3"});
    svg_.text(now, upper - 12, "now", {.size = 10.5, .anchor = "middle", .bold = true});
    return svg_.document(kTimes + kTimeAxis + 40, y + 36, "The mission, done and planned");
  }

 private:
  double x_of(double time_s) const { return kTimes + (time_s - from_s_) / (to_s_ - from_s_) * kTimeAxis; }

  void draw_key() {
    double x = kTimes;
    for (const v1::ChainStage stage :
         {v1::CHAIN_DONE, v1::CHAIN_RUNNING, v1::CHAIN_COMMITTED, v1::CHAIN_PLANNED, v1::CHAIN_FAILED}) {
      svg_.rectangle(x, kTop - 4, 16, 10, ink_of(stage), 2);
      svg_.text(x + 22, kTop + 5, name_of(stage), {.size = 11});
      x += 52 + width_of(name_of(stage), 11);
    }
  }

  void draw_axis(double upper, double lower) {
    for (const double mark : time_marks(from_s_, to_s_, 9)) {
      svg_.line({x_of(mark), upper - 4}, {x_of(mark), lower}, {.stroke = kRule});
      svg_.text(x_of(mark), lower + 16, lib::clock_text(static_cast<std::int64_t>(mark * 1e6)),
                {.size = 11, .colour = kFaint, .anchor = "middle"});
    }
    svg_.line({kTimes, lower}, {kTimes + kTimeAxis, lower}, {.stroke = kFaint});
  }

  // Returns where the next one begins.
  double draw_row(const KindRow& row, double y) {
    svg_.text_within(24, y + 15, kTimes - 70, row.kind, {.size = 12, .bold = true});
    if (row.chains.size() > 1)
      svg_.text(kTimes - 12, y + 15, "× " + std::to_string(row.chains.size()),
                {.size = 10.5, .colour = kFaint, .anchor = "end"});
    for (std::size_t i = 0; i < row.chains.size(); ++i) {
      const v1::ChainOutlook& one = *row.chains[i];
      const double x = x_of(seconds(one.start_us()));
      const double width = std::max(3.0, x_of(seconds(one.end_us())) - x);
      const double top = y + static_cast<double>(row.lane[i]) * kLane;
      svg_.open(one.request() + " (" + name_of(one.stage()) + "), " + lib::clock_text(one.start_us()) +
                " – " + lib::clock_text(one.end_us()) + ", " + one.chain());
      svg_.rectangle(x, top + 2, width, kLane - 5, ink_of(one.stage()), 2);
      const std::string label =
          one.request().size() > row.kind.size() ? one.request().substr(row.kind.size() + 1) : "";
      const bool dark = one.stage() == v1::CHAIN_PLANNED || one.stage() == v1::CHAIN_COMMITTED;
      svg_.text_within(x + 4, top + 14.5, width - 6, label, {.size = 10.5, .colour = dark ? kText : "white"});
      svg_.close();
    }
    return y + static_cast<double>(row.lanes) * kLane + 8;
  }

  const v1::MissionOutlook& outlook_;
  std::vector<KindRow> rows_;
  double from_s_ = 0, to_s_ = 1;
  Svg svg_;
};

}  // namespace

std::string chains_text(const v1::MissionOutlook& outlook) {
  std::string out = printable("Chains of outlook " + made_text(outlook)) + "\n\n";
  std::vector<std::vector<std::string>> rows{{"START", "END", "STAGE", "REQUEST", "CHAIN"}};
  for (const v1::ChainOutlook& one : outlook.chains())
    rows.push_back({lib::clock_text(one.start_us()), lib::clock_text(one.end_us()), name_of(one.stage()),
                    one.request(), one.chain()});
  return out + table_text(rows);
}

json chains_json(const v1::MissionOutlook& outlook) {
  json out = made_json(outlook);
  out["chains"] = json::array();
  for (const v1::ChainOutlook& one : outlook.chains())
    out["chains"].push_back({{"request", one.request()},
                             {"chain", one.chain()},
                             {"block", one.block()},
                             {"stage", name_of(one.stage())},
                             {"start_s", seconds(one.start_us())},
                             {"end_s", seconds(one.end_us())}});
  return out;
}

std::string chains_svg(const v1::MissionOutlook& outlook) { return Mission(outlook).draw(); }

}  // namespace roci::console::cli::outlook
