#include "cli/trade/trade_files.h"

#include <chrono>
#include <utility>

#include "cli/options/quality.h"
#include "common/patch_file/patch_file.h"
#include "loader/load_files.h"
#include "preprocess/convert.h"

namespace relief::cli {
namespace {

using TradeClock = std::chrono::steady_clock;

double seconds_since(TradeClock::time_point start) {
  return std::chrono::duration<double>(TradeClock::now() - start).count();
}

}  // namespace

Result<TradeFiles> TradeFiles::read(const std::filesystem::path& scan, Progress& progress) {
  RELIEF_TRY_ASSIGN(auto folder, TemporaryFolder::make("relief-trade"));
  TradeFiles files(scan, std::move(folder));
  const auto start = TradeClock::now();
  RELIEF_TRY_ASSIGN(auto loaded, load_mesh(scan, {}, progress));
  files.read_seconds_ = seconds_since(start);
  files.points_ = std::move(loaded.points);
  return files;
}

Result<const TradeFiles::Converted*> TradeFiles::convert_once(const OptionValues& conversion,
                                                              Progress& progress) {
  if (const auto found = converted_.find(conversion); found != converted_.end())
    return found->second.get();
  ConvertOptions options;
  PatchFileOptions of_no_file;
  set_conversion(conversion, options, of_no_file);
  Points points = points_;
  const auto start = TradeClock::now();
  auto result = convert(std::move(points), options, progress);
  if (!result) return make_error("{}: {}", scan_.string(), result.error().message);
  auto made = std::make_unique<Converted>(Converted{std::move(*result), seconds_since(start)});
  return converted_.emplace(conversion, std::move(made)).first->second.get();
}

Result<const TradeFile*> TradeFiles::file_of(const OptionValues& conversion,
                                             const OptionValues& file, Progress& progress) {
  const OptionValues both = overlay_options(conversion, file);
  if (const auto found = files_.find(both); found != files_.end()) return found->second.get();
  RELIEF_TRY_ASSIGN(const Converted* const converted, convert_once(conversion, progress));
  ConvertOptions of_no_conversion;
  PatchFileOptions options;
  set_conversion(file, of_no_conversion, options);
  const std::filesystem::path path = folder_.path() / "setting.relief";
  const auto start = TradeClock::now();
  RELIEF_TRY(write_patch_file(path, converted->result.model, options));
  auto made = std::make_unique<TradeFile>();
  made->cost.convert_seconds = read_seconds_ + converted->seconds + seconds_since(start);
  const auto written = TradeClock::now();
  RELIEF_TRY_ASSIGN(const auto opened, PatchFile::open(path));
  RELIEF_TRY_ASSIGN(made->model, opened.read_all(progress));
  made->cost.load_seconds = seconds_since(written);
  made->cost.file_bytes = opened.info().file_bytes;
  made->cost.samples = opened.info().samples;
  made->cost.patches = opened.info().patches;
  made->cost.surface_psnr_db = converted->result.report.psnr_db;
  return files_.emplace(both, std::move(made)).first->second.get();
}

}  // namespace relief::cli
