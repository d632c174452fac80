#include "core/bytes/fnv_1a.hpp"

#include <gtest/gtest.h>

#include <string>

namespace roci::bytes {
namespace {

// Test vectors of draft-eastlake-fnv.
TEST(Fnv1a, IsThePublishedHash) {
  EXPECT_EQ(fnv_1a(""), 0xcbf29ce484222325U);
  EXPECT_EQ(fnv_1a("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(fnv_1a("foobar"), 0x85944171f73967e8U);
}

TEST(Fnv1a, PiecesCountAsTheWhole) {
  EXPECT_EQ(Fnv1a().add("foo").add("bar").value(), fnv_1a("foobar"));
  EXPECT_EQ(Fnv1a().add_number(0x7261'626f'6f66U).value(), fnv_1a(std::string("foobar\0\0", 8)));
}

TEST(Fnv1a, ASeedGivesAnotherHashUnlessItIsZero) {
  EXPECT_EQ(Fnv1a(0).add("foobar").value(), fnv_1a("foobar"));
  EXPECT_NE(Fnv1a(1).add("foobar").value(), fnv_1a("foobar"));
}

}  // namespace
}  // namespace roci::bytes
