#include "lambent/file/budget.h"

#include <gtest/gtest.h>

namespace lambent::file {
namespace {

TEST(Budget, RefusesWhatAFileOfThatSizeCannotNeed) {
  Budget budget;
  budget.addFile(1000);
  EXPECT_EQ(budget.limit(), kFloorBytes + 1000 * kBytesPerByte);
  EXPECT_TRUE(budget.hold(kFloorBytes, "a.png"));
  const Status refused = budget.hold(kFloorBytes, "b.png");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
  EXPECT_EQ(refused.error().message,
            "b.png would take 512.0 MiB, with 512.0 MiB for what came before it, over the limit of "
            "513.0 MiB for one file of 1000 bytes; make it smaller, or allow more "
            "(--memory-limit)");
  budget.release(kFloorBytes);
  EXPECT_TRUE(budget.hold(1000 * kBytesPerByte, "b.png"));
  EXPECT_FALSE(budget.work(1, "b.png"));
  EXPECT_FALSE(budget.hold(~std::uint64_t(0), "c.png"));
}

TEST(Budget, LargeFilesMeetTheCeiling) {
  Budget budget;
  budget.addFile(std::uint64_t(1) << 60);
  EXPECT_EQ(budget.limit(), kMostBytes);
}

TEST(Budget, TheCallersLimitIsTheLimit) {
  Budget budget(std::uint64_t(100));
  budget.addFile(1 << 20);
  EXPECT_TRUE(budget.hold(100, "a"));
  EXPECT_FALSE(budget.hold(1, "a"));
}

TEST(Budget, WorkIsBoundedThoughNothingIsHeld) {
  Budget budget(std::uint64_t(100));
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(budget.hold(100, "a"));
    budget.release(100);
  }
  const Status refused = budget.hold(100, "a");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("to 900 bytes, over the limit of 800 bytes"),
            std::string::npos)
      << refused.error().message;
}

}  // namespace
}  // namespace lambent::file
