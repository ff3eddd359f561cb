// Ctrl-C at any moment: the command ends soon, with exit code 1, and leaves no partial file.
// scripts/measure_interrupt.py measures how soon.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "cli/interrupt.h"
#include "common/io/file.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

using std::chrono::milliseconds;

/// Far above the 0.3 s after which the process ends itself: a busy machine may not run it at once.
constexpr double kSoon = 10.0;

class Interrupts : public CliTest {
 protected:
  /// Runs the whole, and then interrupts it at moments spread over its time.
  void interrupt_often(const std::vector<std::string>& arguments, const std::string& output,
                       int times) const {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(run_relief(arguments).exit_code, 0);
    const auto whole =
        std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - start);
    std::filesystem::remove(output);
    const std::vector<std::string> before = files();
    std::mt19937 random(1);
    std::uniform_int_distribution<milliseconds::rep> moments(
        1, std::max<milliseconds::rep>(2, whole.count()));
    for (int i = 0; i < times; ++i) {
      RunOptions options;
      options.interrupt_after = milliseconds(moments(random));
      const Outcome run = run_relief(arguments, options);
      EXPECT_LT(run.seconds_after_interrupt, kSoon);
      if (run.exit_code == 0) {  // it was done before
        std::filesystem::remove(output);
        continue;
      }
      if (run.exit_code == -SIGINT) {  // it had not begun: no handler was there
        EXPECT_EQ(run.err, "");
      } else {
        EXPECT_EQ(run.exit_code, 1) << run.err;
        EXPECT_EQ(run.err.rfind("relief: interrupted; ", 0), 0U) << run.err;
      }
      EXPECT_EQ(run.out, "");
      EXPECT_EQ(files(), before) << "after " << options.interrupt_after->count() << " ms";
    }
  }
};

TEST_F(Interrupts, OfConversionsLeaveNothing) {
  interrupt_often({"convert", write_knot(20000), "-o", path("a.relief")}, path("a.relief"), 6);
}

TEST_F(Interrupts, OfImagesLeaveNothing) {
  const std::string scan = write_knot(5000);
  ASSERT_EQ(run_relief({"convert", scan, "-o", path("a.relief")}).exit_code, 0);
  for (const std::string engine : {"onepass", "multipass", "ewa", "raytrace"}) {
    interrupt_often(
        {"render", path("a.relief"), "-o", path("a.exr"), "--engine", engine, "--size", "300x300"},
        path("a.exr"), 2);
  }
  interrupt_often(
      {"render", path("a.relief"), "-o", path("a.png"), "--samples", "16", "--size", "800x800"},
      path("a.png"), 2);
  interrupt_often(
      {"render", path("a.relief"), "-o", path("a.png"), "--explain-cost", "--size", "300x300"},
      path("a.png"), 2);
}

/// What a driver or a library does: it runs for long and does not look.
[[noreturn]] void never_look(const std::string& output) {
  cli::handle_signals();
  const cli::InterruptedFiles files({output}, nullptr);
  auto file = AtomicFile::create(output);
  if (!file || !file->write(std::as_bytes(std::span("half")))) std::_Exit(3);
  raise(SIGINT);
  std::this_thread::sleep_for(std::chrono::minutes(1));
  std::_Exit(4);
}

using InterruptsDeathTest = Interrupts;

TEST_F(InterruptsDeathTest, EndAProcessThatDoesNotLook) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  // The test runs again from its start in the process that ends, so the folder has a fixed name.
  const std::string folder = std::filesystem::temp_directory_path() / "relief-interrupt-test";
  std::filesystem::create_directories(folder);
  EXPECT_EXIT(never_look(folder + "/out.relief"), testing::ExitedWithCode(1),
              "relief: interrupted; nothing was written");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace relief::test
