#include "sim_svc/scenario/file_values.hpp"

namespace roci::sim::scenario {

using mission::Entry;
using temporal::Time;

double at_least(const Entry& entry, double least) {
  const double value = entry.number();
  if (value < least) entry.fail("must be at least " + std::to_string(least) + "; correct the number");
  return value;
}

Time time_of(const Entry& entry) {
  const double s = at_least(entry, 0);
  if (s > 1e9) entry.fail("lies more than 30 years ahead; times are in seconds");
  return temporal::seconds(s);
}

world::Rock read_rock(const Entry& entry) {
  entry.allow_only({"x", "y", "radius"});
  return {entry.at("x").number(), entry.at("y").number(), at_least(entry.at("radius"), 0.01)};
}

}  // namespace roci::sim::scenario
