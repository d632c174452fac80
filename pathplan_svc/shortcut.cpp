#include "pathplan_svc/shortcut.hpp"

#include <algorithm>
#include <limits>

namespace roci::pathplan {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Is the straight piece from one corner to a later one.
struct Piece {
  double time = kInfinity;
  double heading = 0;
  double arrival = kInfinity;  // least time at its end, having come along it
  std::size_t before = 0;      // the corner where the piece before it starts
};

class Pieces {
 public:
  explicit Pieces(std::size_t corners) : corners_(corners), pieces_(corners * corners) {}
  Piece& at(std::size_t from, std::size_t to) { return pieces_[from * corners_ + to]; }

 private:
  std::size_t corners_;
  std::vector<Piece> pieces_;
};

}  // namespace

Polyline shortcut(const Costmap& map, const DriveModel& drive, const Polyline& path, double max_piece) {
  const std::size_t n = path.size();
  if (n < 3) return path;
  Pieces pieces(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const bool neighbours = j == i + 1;
      if (!neighbours && (terrain::distance(path[i], path[j]) > max_piece || !is_free(map, path[i], path[j])))
        continue;
      Piece& piece = pieces.at(i, j);
      piece.time = drive_time(map, drive, path[i], path[j]);
      piece.heading = heading(path[i], path[j]);
      if (i == 0) piece.arrival = drive.turn_time(kFirstTurn) + piece.time;
    }
  }
  for (std::size_t j = 1; j + 1 < n; ++j) {
    for (std::size_t k = j + 1; k < n; ++k) {
      Piece& next = pieces.at(j, k);
      if (next.time == kInfinity) continue;
      for (std::size_t i = 0; i < j; ++i) {
        const Piece& last = pieces.at(i, j);
        if (last.arrival == kInfinity) continue;
        const double arrival =
            last.arrival + drive.turn_time(turn_between(last.heading, next.heading)) + next.time;
        if (arrival < next.arrival) {
          next.arrival = arrival;
          next.before = i;
        }
      }
    }
  }
  std::size_t from = 0;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (pieces.at(i, n - 1).arrival < pieces.at(from, n - 1).arrival) from = i;
  }
  Polyline backwards{path[n - 1]};
  std::size_t to = n - 1;
  while (true) {
    backwards.push_back(path[from]);
    if (from == 0) break;
    const std::size_t before = pieces.at(from, to).before;
    to = from;
    from = before;
  }
  return {backwards.rbegin(), backwards.rend()};
}

Polyline thin(const Costmap& map, const Polyline& path, std::size_t corners) {
  if (path.size() <= corners) return path;
  const std::size_t stride = (path.size() + corners - 1) / corners;
  Polyline kept{path.front()};
  std::size_t last = 0;
  while (last + 1 < path.size()) {
    std::size_t next = std::min(last + stride, path.size() - 1);
    while (next > last + 1 && !is_free(map, path[last], path[next])) --next;
    kept.push_back(path[next]);
    last = next;
  }
  return kept;
}

}  // namespace roci::pathplan
