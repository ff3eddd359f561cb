// Runs the built `relief` command as a user's shell would, and looks at all it leaves.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace relief::test {

/// What a run left behind.
struct Outcome {
  int exit_code = 0;  ///< minus the signal's number if one ended it
  std::string out;
  /// Without the lines of progress that a job of more than ten seconds prints on a busy machine.
  std::string err;
  double seconds_after_interrupt = 0.0;  ///< until the exit, with `interrupt_after`
};

struct RunOptions {
  std::vector<std::pair<std::string, std::string>> environment;  ///< added to the test's own
  std::optional<std::uint64_t> largest_file;  ///< bytes; a write beyond them fails (RLIMIT_FSIZE)
  bool terminal = false;                      ///< standard error is a terminal
  std::string interrupt_at;  ///< with `terminal`: SIGINT once standard error shows this text
  std::optional<std::chrono::milliseconds> interrupt_after;  ///< SIGINT so long after the start
  bool closed_out = false;  ///< standard output is closed, as by `>&-`
  bool unread_out = false;  ///< standard output is a pipe whose reader has left, as by `| head -0`
};

Outcome run_relief(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// A test with a directory of its own, gone afterwards.
class CliTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// A path in the directory.
  [[nodiscard]] std::string path(const std::string& name) const { return directory_ / name; }
  /// Writes a file into the directory and returns its path.
  std::string write(const std::string& name, const std::string& bytes) const;
  /// Writes the generated knot (models/knot_scan.h) and returns its path.
  std::string write_knot(std::size_t points) const;
  /// Names of all files in the directory, sorted.
  [[nodiscard]] std::vector<std::string> files() const;

  /// Runs `arguments`, which must fail as every failure should: exit code 1, one line on standard
  /// error that names `about`, nothing on standard output, and no file made or left.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& about,
                      const RunOptions& options = {}) const;

 private:
  std::filesystem::path directory_;
};

/// The bytes of a file; empty if there is none.
std::string file_bytes(const std::string& path);

}  // namespace relief::test
