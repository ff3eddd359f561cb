#include "common/guard.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/sanitizers/address_sanitizer.h"

namespace relief {
namespace {

const GuardedCall kCall{.subject = "a.ply",
                        .task = "read it",
                        .library = "libply",
                        .advice = "write it again",
                        .memory_advice = "use a smaller file"};

TEST(GuardTest, ReturnsWhatTheWorkReturns) {
  const auto value = guarded(kCall, []() -> Result<int> { return 7; });
  ASSERT_TRUE(value);
  EXPECT_EQ(*value, 7);
  EXPECT_TRUE(guarded(kCall, [] { return Status(); }));
  EXPECT_EQ(guarded(kCall, []() -> Status { return make_error("a fault"); }).error().message,
            "a fault");
}

TEST(GuardTest, ExceptionsBecomeErrors) {
  const auto throwing = [](const auto& exception) {
    return guarded(kCall, [&]() -> Status { throw exception; }).error().message;
  };
  EXPECT_EQ(throwing(std::out_of_range("at")),
            "a.ply: libply failed to read it (at); write it again");
  EXPECT_EQ(throwing(7), "a.ply: libply failed to read it (unknown reason); write it again");
  EXPECT_EQ(throwing(std::bad_alloc()), "a.ply: not enough memory to read it; use a smaller file");
  EXPECT_EQ(guarded({.subject = "",
                     .task = "convert 5 points",
                     .advice = kReportDefect,
                     .memory_advice = kMoreMemory},
                    []() -> Status { throw std::runtime_error("x"); })
                .error()
                .message,
            "Relief failed to convert 5 points (x); this is a defect: report it with the command "
            "and its input");
}

TEST(GuardTest, AVectorThatNoMemoryHoldsIsAnError) {
  if (test::kAddressSanitizer) GTEST_SKIP() << "it ends a process that asks for so much memory";
  const auto huge = guarded(kCall, []() -> Result<std::vector<double>> {
    std::vector<double> values;
    values.resize(values.max_size());
    return values;
  });
  ASSERT_FALSE(huge);
  EXPECT_EQ(huge.error().message, "a.ply: not enough memory to read it; use a smaller file");
}

}  // namespace
}  // namespace relief
