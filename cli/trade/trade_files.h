// The patch files that the settings of `relief bench --trade` draw.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "cli/trade/trade_row.h"
#include "common/error.h"
#include "common/io/temporary_folder.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/convert_options.h"

namespace relief::cli {

/// A patch file, read back: what its codec rounds is rounded in the pictures, too.
struct TradeFile {
  PatchModel model;
  TradeFileCost cost;
};

/// Converts a scan with the options that it is asked for, each combination once.
class TradeFiles {
 public:
  /// Reads the scan or mesh, and makes a folder for one file at a time, which it removes at the
  /// end.
  static Result<TradeFiles> read(const std::filesystem::path& scan, Progress& progress);

  [[nodiscard]] const Points& points() const { return points_; }

  /// The file with these options of `relief convert`; `conversion` are those without the file's
  /// own. It stays where it is as long as this lives. Fails as a conversion does.
  Result<const TradeFile*> file_of(const OptionValues& conversion, const OptionValues& file,
                                   Progress& progress);

 private:
  struct Converted {
    ConvertResult result;
    double seconds = 0.0;
  };

  TradeFiles(std::filesystem::path scan, TemporaryFolder folder)
      : scan_(std::move(scan)), folder_(std::move(folder)) {}
  Result<const Converted*> convert_once(const OptionValues& conversion, Progress& progress);

  std::filesystem::path scan_;
  TemporaryFolder folder_;
  Points points_;
  double read_seconds_ = 0.0;
  std::map<OptionValues, std::unique_ptr<Converted>> converted_;
  std::map<OptionValues, std::unique_ptr<TradeFile>> files_;
};

}  // namespace relief::cli
