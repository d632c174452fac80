#include "tests/fuzz/topics/sample_maker.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>

#include "roci_idl/contract.h"
#include "services/transport/announcement.hpp"

namespace roci::fuzz {
namespace {

using services::transport::Payload;

enum class Shape { one, sequence, array };

struct Member {
  std::string name;
  std::string type;
  Shape shape;
  std::size_t size;     // of an array
  std::uint32_t least;  // bytes of an element
};

#include "layout.inc"

constexpr std::size_t kHeader = 4;  // of the encapsulation; alignment counts from its end

const std::vector<std::string> kWords{"",
                                      "rover",
                                      "rover.nav",
                                      "rover.camera",
                                      "rover.arm",
                                      "rover.battery",
                                      "rover.x",
                                      "rover.y",
                                      "idle-at",
                                      "going-to",
                                      "idle",
                                      "imaging",
                                      "ground",
                                      "photo",
                                      "sample",
                                      "x",
                                      "y",
                                      "110",
                                      "60",
                                      "a",
                                      "b",
                                      "sim_svc",
                                      "exec_svc",
                                      "planner_svc",
                                      "pathplan_svc",
                                      "arm_svc",
                                      "science_svc",
                                      "stow",
                                      "here",
                                      "nav",
                                      "camera",
                                      "drive",
                                      "take-image",
                                      "stop",
                                      "traverse_time",
                                      "traverse_energy",
                                      "pathplan",
                                      "arm",
                                      "location",
                                      "image",
                                      "temporal_pddl",
                                      "planetary-1",
                                      "p1.1-drive",
                                      "first",
                                      "second",
                                      "roci/path/request",
                                      "1e308",
                                      "-1",
                                      "nan",
                                      "../../etc",
                                      "%s%n",
                                      "(at here)",
                                      "\xff\xfe",
                                      "\x1b[2J",
                                      "rover.image.a",
                                      "rover.sample.a"};

constexpr std::array<std::int64_t, 12> kNumbers{0,
                                                1,
                                                -1,
                                                2,
                                                1000,
                                                1'000'000,
                                                60'000'000,
                                                std::numeric_limits<std::int32_t>::max(),
                                                std::numeric_limits<std::int32_t>::min(),
                                                std::numeric_limits<std::int64_t>::max(),
                                                std::numeric_limits<std::int64_t>::min(),
                                                4'294'967'295};

constexpr std::array<double, 12> kReals{0,
                                        1,
                                        -1,
                                        0.5,
                                        110,
                                        60,
                                        1e9,
                                        1e308,
                                        -1e308,
                                        1e-320,
                                        std::numeric_limits<double>::infinity(),
                                        std::numeric_limits<double>::quiet_NaN()};

class Writing {
 public:
  Writing(SampleMaker& maker, std::size_t longest) : maker_(maker), longest_(longest) {
    out_.payload = {0, 1, 0, 0};  // CDR, little-endian
  }

  void structure(const std::string& type, std::size_t depth) {
    for (const Member& member : kStructs.at(type)) {
      switch (member.shape) {
        case Shape::one:
          value(member, depth);
          break;
        case Shape::array:
          for (std::size_t i = 0; i < member.size; ++i) value(member, depth);
          break;
        case Shape::sequence:
          sequence(member, depth);
      }
    }
  }

  MadeSample take() { return std::move(out_); }

 private:
  void sequence(const Member& member, std::size_t depth) {
    const std::size_t count = maker_.below(std::max<std::size_t>(longest_ >> (2 * depth), 1) + 1);
    align(4);
    mark(Mark::Kind::count, member.least);
    number(static_cast<std::uint32_t>(count), 4);
    for (std::size_t i = 0; i < count; ++i) value(member, depth + 1);
  }

  void value(const Member& member, std::size_t depth) {
    const std::string& type = member.type;
    if (kStructs.contains(type)) return structure(type, depth);
    if (const auto found = kEnums.find(type); found != kEnums.end()) {
      align(4);
      mark(Mark::Kind::enumerator, found->second);
      return number(maker_.below(found->second), 4);
    }
    if (type == "string") return text(member.name == "run" && maker_.below(16) != 0 ? maker_.run() : word());
    if (type == "boolean") return number(maker_.below(2), 1);
    if (type == "octet") return number(maker_.below(256), 1);
    if (type == "double") {
      std::uint64_t bits = 0;
      const double real = kReals[maker_.below(kReals.size())];
      std::memcpy(&bits, &real, sizeof bits);
      return number(bits, 8);
    }
    const std::size_t width = type.ends_with("long long") ? 8 : type.ends_with("long") ? 4 : 2;
    number(static_cast<std::uint64_t>(kNumbers[maker_.below(kNumbers.size())]), width);
  }

  std::string word() {
    if (maker_.below(64) == 0) return std::string(maker_.below(2000), 'x');
    if (!maker_.words().empty() && maker_.below(2) == 0)
      return maker_.words()[maker_.below(maker_.words().size())];
    return kWords[maker_.below(kWords.size())];
  }

  void text(const std::string& text) {
    align(4);
    mark(Mark::Kind::text_length, 1);
    number(text.size() + 1, 4);
    if (!text.empty()) mark(Mark::Kind::text, static_cast<std::uint32_t>(text.size()));
    out_.payload.insert(out_.payload.end(), text.begin(), text.end());
    out_.payload.push_back(0);
  }

  void align(std::size_t width) {
    while ((out_.payload.size() - kHeader) % width != 0) out_.payload.push_back(0);
  }
  void mark(Mark::Kind kind, std::uint32_t least) {
    out_.marks.push_back({kind, out_.payload.size(), least});
  }
  void number(std::uint64_t number, std::size_t width) {
    align(width);
    for (std::size_t i = 0; i < width; ++i)
      out_.payload.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
  }

  SampleMaker& maker_;
  std::size_t longest_;
  MadeSample out_;
};

}  // namespace

void put(Payload& payload, std::size_t offset, std::uint32_t number) {
  for (std::size_t i = 0; i < 4 && offset + i < payload.size(); ++i)
    payload[offset + i] = static_cast<std::uint8_t>(number >> (8 * i));
}

MadeSample SampleMaker::make(const std::string& type, std::size_t longest) {
  Writing writing(*this, longest);
  writing.structure(type, 0);
  return writing.take();
}

Payload SampleMaker::damaged(const MadeSample& sample) {
  Payload out = sample.payload;
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
    switch (below(5)) {
      case 0:
      case 1:
        if (!sample.marks.empty()) {
          const std::array<std::uint32_t, 7> lies{
              0, 1, 77, 0x10000, 0x7fffffff, 0xffffffff, static_cast<std::uint32_t>(out.size())};
          put(out, sample.marks[below(sample.marks.size())].offset, lies[below(lies.size())]);
        }
        break;
      case 2:
        if (!out.empty()) out[below(out.size())] = static_cast<std::uint8_t>(below(256));
        break;
      case 3:
        out.resize(below(out.size() + 1));
        break;
      default:
        const std::size_t from = below(out.size() + 1);
        const Payload again(
            out.begin() + static_cast<std::ptrdiff_t>(from),
            out.begin() +
                static_cast<std::ptrdiff_t>(from + below(std::min<std::size_t>(out.size() - from, 64) + 1)));
        out.insert(out.begin() + static_cast<std::ptrdiff_t>(below(out.size() + 1)), again.begin(),
                   again.end());
    }
  }
  return out;
}

std::vector<std::string> topic_types() {
  const auto announced = services::transport::parse_announcement(ROCI_ANNOUNCEMENT);
  if (!announced) throw std::logic_error("the contract's announcement cannot be read");
  std::vector<std::string> types;
  for (const auto& [type, hash] : announced->hashes) types.push_back(type);
  return types;
}

}  // namespace roci::fuzz
