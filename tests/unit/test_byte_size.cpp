#include <gtest/gtest.h>

#include "byte_size.h"

namespace hlodbench {
namespace {

TEST(ByteSize, ReadsNumbersWithAndWithoutUnits) {
  EXPECT_EQ(parseByteSize("1"), 1u);
  EXPECT_EQ(parseByteSize("64K"), 65536u);
  EXPECT_EQ(parseByteSize("256M"), 268435456u);
  EXPECT_EQ(parseByteSize("3G"), 3221225472u);
}

TEST(ByteSize, IsNothingForAnythingElse) {
  for (const char* text : {"", "0", "0K", "K", "-1", "+1", " 1", "1 ", "1.5G", "1e6", "12KB", "12k",
                           "0x10", "99999999999999999999", "18446744073709551615", "17179869184G"})
    EXPECT_EQ(parseByteSize(text), std::nullopt) << text;
}

}  // namespace
}  // namespace hlodbench
