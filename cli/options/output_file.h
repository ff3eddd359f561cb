// A file to write, or standard output.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "common/error.h"
#include "common/io/temporary_folder.h"

namespace relief::cli {

/// The output of a subcommand. If it is named "-", the file is written to a folder of its own and
/// then copied to standard output, and the report goes to standard error.
class OutputFile {
 public:
  /// `extension`: of what is written to standard output, with its dot. Fails if that is a terminal.
  static Result<OutputFile> open(const std::filesystem::path& named, std::string_view extension);

  /// Where to write.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Sends what was written to standard output, if it is to go there, and prints the report.
  /// Returns the exit code.
  int finish(std::string_view report);
  int finish_json(const nlohmann::ordered_json& report);

 private:
  OutputFile(std::filesystem::path path, std::optional<TemporaryFolder> folder)
      : path_(std::move(path)), folder_(std::move(folder)) {}
  Status send();

  std::filesystem::path path_;
  std::optional<TemporaryFolder> folder_;  ///< none: a file that the user has named
};

/// Refuses --json where standard output is the file itself. Throws CLI::ValidationError.
void check_json(const std::filesystem::path& output, bool json);

}  // namespace relief::cli
