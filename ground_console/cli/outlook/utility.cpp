// Utility by rank of chains and data, predicted and executed (R113, R115).
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ground_console/cli/outlook/outlook.hpp"
#include "ground_console/cli/outlook/words.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::outlook {
namespace {

using nlohmann::json;

constexpr double kLabels = 250;
constexpr double kColumn = 128;
constexpr double kRow = 20;
constexpr char kGone[] = "#aab3bd";  // data that will not come

double score(const std::vector<double>& scores, std::size_t rank) {
  return rank < scores.size() && std::isfinite(scores[rank]) ? scores[rank] : 0.0;
}

std::string in_ranks(const std::vector<double>& scores, const std::vector<v1::UtilityRank>& ranks) {
  std::string out;
  for (std::size_t rank = 0; rank < ranks.size(); ++rank)
    if (score(scores, rank) != 0)
      out += (out.empty() ? "" : ", ") + ranks[rank].name() + " " + lib::value_text(score(scores, rank));
  return out.empty() ? "0" : out;
}

std::string rounded(double value) { return lib::value_text(std::round(value * 1e3) / 1e3); }

// One line of the picture.
struct Row {
  std::string name;
  std::string state;
  const std::vector<double>* predicted = nullptr;
  const std::vector<double>* executed = nullptr;
  std::string cost;
};

bool greater(const Row& a, const Row& b, std::size_t ranks) {
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    const double one = std::max(score(*a.predicted, rank), score(*a.executed, rank));
    const double other = std::max(score(*b.predicted, rank), score(*b.executed, rank));
    if (one != other) return one > other;
  }
  return false;
}

// "request/task/product" says most with its ends.
std::string short_name(const std::string& id) {
  const std::size_t first = id.find('/');
  const std::size_t last = id.rfind('/');
  return first == last ? id : id.substr(0, first) + "/…" + id.substr(last);
}

bool has_worth(const Row& row, std::size_t ranks) {
  for (std::size_t rank = 0; rank < ranks; ++rank)
    if (score(*row.predicted, rank) != 0 || score(*row.executed, rank) != 0) return true;
  return false;
}

std::vector<Row> chain_rows(const v1::MissionOutlook& outlook) {
  std::vector<Row> out;
  for (const v1::ChainOutlook& one : outlook.chains())
    out.push_back({one.title() == one.request() ? one.request() : one.request() + "  " + one.title(),
                   name_of(one.stage()), &one.predicted(), &one.executed(), joules_text(one.cost_j())});
  std::ranges::stable_sort(out,
                           [&](const Row& a, const Row& b) { return greater(a, b, outlook.ranks().size()); });
  return out;
}

std::vector<Row> product_rows(const v1::MissionOutlook& outlook) {
  std::vector<Row> out;
  for (const v1::ProductOutlook& one : outlook.products())
    out.push_back({short_name(one.data().id()), one.data().exists() ? name_of(one.fate()) : "planned",
                   &one.predicted(), &one.executed(), bytes_text(one.data().bytes())});
  std::ranges::stable_sort(out,
                           [&](const Row& a, const Row& b) { return greater(a, b, outlook.ranks().size()); });
  return out;
}

class Picture {
 public:
  explicit Picture(const v1::MissionOutlook& outlook) : outlook_(outlook) {
    find_columns(outlook.chains());
    find_columns(outlook.products());
    std::ranges::sort(columns_, {}, &Column::rank);
    width_ = std::max(860.0, kLabels + kColumn * static_cast<double>(columns_.size()) + 210);
  }

  std::string draw() {
    draw_title(svg_, "Utility by rank", "Version " + made_text(outlook_));
    double y = draw_legend(kTop);
    y = draw_part("Chains", "cost", chain_rows(outlook_), y);
    y = draw_part("Data", "bytes", product_rows(outlook_), y + 14);
    y = draw_meanings(y + 16);
    return svg_.document(width_, y + 8, "Utility by rank");
  }

 private:
  struct Column {
    std::size_t rank = 0;
    double most = 0;
  };

  // Ranks at which nothing has a score have no column.
  template <class List>
  void find_columns(const List& list) {
    for (const auto& one : list)
      for (std::size_t rank = 0; rank < outlook_.ranks().size(); ++rank) {
        const double most = std::max(score(one.predicted(), rank), score(one.executed(), rank));
        if (most <= 0) continue;
        auto column = std::ranges::find(columns_, rank, &Column::rank);
        if (column == columns_.end()) column = columns_.insert(columns_.end(), Column{rank, 0});
        column->most = std::max(column->most, most);
      }
  }

  double draw_legend(double y) {
    svg_.rectangle(24, y, 22, 10, {.fill = kPaleBlue}, 1);
    svg_.text(52, y + 9.5, "predicted", {.size = 11});
    svg_.rectangle(124, y + 2.5, 22, 5, {.fill = kGreen}, 1);
    svg_.text(152, y + 9.5, "executed: as its data turned out", {.size = 11});
    svg_.text(372, y + 9.5, "Ranks from left to right; any gain outweighs all gains to the right of it.",
              {.size = 11, .colour = kFaint});
    return y + 34;
  }

  double x_of(std::size_t column) const { return kLabels + 90 + kColumn * static_cast<double>(column); }

  double draw_part(const std::string& title, const std::string& last, std::vector<Row> rows, double y) {
    const std::size_t all = rows.size();
    std::erase_if(rows, [&](const Row& row) { return !has_worth(row, outlook_.ranks().size()); });
    const std::size_t worthless = all - rows.size();
    svg_.text(24, y, title + " (" + std::to_string(all) + ")", {.size = 13, .bold = true});
    for (std::size_t i = 0; i < columns_.size(); ++i)
      svg_.text_within(x_of(i), y, kColumn - 8, outlook_.ranks()[columns_[i].rank].name(),
                       {.size = 11, .bold = true});
    svg_.text(width_ - 24, y, last, {.size = 11, .colour = kFaint, .anchor = "end"});
    svg_.line({24, y + 6}, {width_ - 24, y + 6}, {.stroke = kRule});
    y += 12;
    for (std::size_t i = 0; i < std::min(rows.size(), kMostRows); ++i, y += kRow) draw_row(rows[i], y);
    if (rows.size() > kMostRows) {
      svg_.text(24, y + 13, "and " + std::to_string(rows.size() - kMostRows) + " more", {.size = 11});
      y += kRow;
    }
    if (worthless > 0 || all == 0) {
      svg_.text(24, y + 13,
                all == 0 ? "none" : std::to_string(worthless) + " more are worth nothing by themselves",
                {.size = 11, .colour = kFaint});
      y += kRow;
    }
    return y + 14;
  }

  void draw_row(const Row& row, double y) {
    svg_.text_within(24, y + 13, kLabels - 30, row.name, {.size = 11.5});
    const bool bad = row.state == "failed" || row.state == "lost" || row.state == "discarded";
    svg_.text(kLabels, y + 13, row.state, {.size = 10.5, .colour = bad ? kRed : kFaint});
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const double scale = (kColumn - 66) / columns_[i].most;
      const double predicted = score(*row.predicted, columns_[i].rank);
      const double executed = score(*row.executed, columns_[i].rank);
      svg_.line({x_of(i), y + 1}, {x_of(i), y + kRow - 2}, {.stroke = kRule});
      if (predicted > 0) svg_.rectangle(x_of(i), y + 4, predicted * scale, 10, {.fill = kPaleBlue}, 1);
      if (executed > 0)
        svg_.rectangle(x_of(i), y + 6.5, executed * scale, 5, {.fill = bad ? kGone : kGreen}, 1);
      const double most = std::max(predicted, executed);
      if (most <= 0) continue;
      const bool both = executed > 0 && predicted > 0 && rounded(executed) != rounded(predicted);
      svg_.text(x_of(i) + most * scale + 4, y + 13,
                both ? rounded(executed) + " of " + rounded(predicted) : rounded(most),
                {.size = 10, .colour = executed > 0 && !bad ? kGreen : kFaint});
    }
    svg_.text(width_ - 24, y + 13, row.cost, {.size = 11, .colour = kFaint, .anchor = "end"});
  }

  double draw_meanings(double y) {
    svg_.text(24, y, "What the ranks mean, the highest first", {.size = 13, .bold = true});
    svg_.line({24, y + 6}, {width_ - 24, y + 6}, {.stroke = kRule});
    y += 22;
    for (const v1::UtilityRank& rank : outlook_.ranks()) {
      svg_.text_within(24, y, 150, rank.name(), {.size = 11.5, .bold = true});
      for (const std::string& line :
           lines_of(rank.meaning(), static_cast<std::size_t>((width_ - 210) / (11 * 0.58)))) {
        svg_.text_within(180, y, width_ - 204, line, {.size = 11});
        y += 15;
      }
      y += 3;
    }
    return y;
  }

  const v1::MissionOutlook& outlook_;
  std::vector<Column> columns_;  // by rank
  double width_ = 0;
  Svg svg_;
};

}  // namespace

std::string utility_text(const v1::MissionOutlook& outlook) {
  std::string out = printable("Mission outlook " + made_text(outlook)) + "\n\n";
  std::vector<std::vector<std::string>> ranks{{"RANK", "WHAT EARNS UTILITY THERE"}};
  for (const v1::UtilityRank& rank : outlook.ranks()) ranks.push_back({rank.name(), rank.meaning()});
  out += table_text(ranks);
  std::vector<std::vector<std::string>> chains{
      {"REQUEST", "STAGE", "START", "END", "COST", "PREDICTED", "EXECUTED"}};
  for (const v1::ChainOutlook& one : outlook.chains())
    chains.push_back({one.request(), name_of(one.stage()), lib::clock_text(one.start_us()),
                      lib::clock_text(one.end_us()), joules_text(one.cost_j()),
                      in_ranks(one.predicted(), outlook.ranks()), in_ranks(one.executed(), outlook.ranks())});
  out += "\n" + table_text(chains);
  if (!outlook.products().empty()) {
    std::vector<std::vector<std::string>> products{
        {"DATA", "FATE", "TIER", "BYTES", "PREDICTED", "EXECUTED"}};
    for (const v1::ProductOutlook& one : outlook.products())
      products.push_back({one.data().id(), one.data().exists() ? name_of(one.fate()) : "planned",
                          name_of(one.data().tier()), std::to_string(one.data().bytes()),
                          in_ranks(one.predicted(), outlook.ranks()),
                          one.data().exists() ? in_ranks(one.executed(), outlook.ranks()) : ""});
    out += "\n" + table_text(products);
  }
  out += "\n" + printable("On Earth: " + in_ranks(outlook.received(), outlook.ranks())) + "\n";
  if (outlook.omitted() > 0) out += std::to_string(outlook.omitted()) + " more had no room in the message.\n";
  return out;
}

json utility_json(const v1::MissionOutlook& outlook) {
  json out = made_json(outlook);
  out["ranks"] = json::array();
  for (const v1::UtilityRank& rank : outlook.ranks())
    out["ranks"].push_back({{"name", rank.name()}, {"meaning", rank.meaning()}});
  out["received"] = outlook.received();
  out["chains"] = json::array();
  for (const v1::ChainOutlook& one : outlook.chains())
    out["chains"].push_back({{"request", one.request()},
                             {"title", one.title()},
                             {"chain", one.chain()},
                             {"block", one.block()},
                             {"stage", name_of(one.stage())},
                             {"start_s", seconds(one.start_us())},
                             {"end_s", seconds(one.end_us())},
                             {"predicted", one.predicted()},
                             {"executed", one.executed()},
                             {"cost_j", one.cost_j()}});
  out["products"] = json::array();
  for (const v1::ProductOutlook& one : outlook.products())
    out["products"].push_back({{"id", one.data().id()},
                               {"exists", one.data().exists()},
                               {"request", one.request()},
                               {"bytes", one.data().bytes()},
                               {"tier", name_of(one.data().tier())},
                               {"fate", one.data().exists() ? name_of(one.fate()) : "planned"},
                               {"predicted", one.predicted()},
                               {"executed", one.executed()}});
  return out;
}

std::string utility_svg(const v1::MissionOutlook& outlook) { return Picture(outlook).draw(); }

}  // namespace roci::console::cli::outlook
