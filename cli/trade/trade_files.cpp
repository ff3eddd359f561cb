#include "cli/trade/trade_files.h"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <system_error>
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
  TradeFiles files;
  files.scan_ = scan;
  const auto start = TradeClock::now();
  RELIEF_TRY_ASSIGN(auto loaded, load_mesh(scan, {}, progress));
  files.read_seconds_ = seconds_since(start);
  files.points_ = std::move(loaded.points);
  std::error_code ignored;
  std::string folder =
      (std::filesystem::temp_directory_path(ignored) / "relief-trade-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr)
    return make_error("{}: cannot be made: {}", folder, std::generic_category().message(errno));
  files.folder_ = folder;
  return files;
}

TradeFiles::TradeFiles(TradeFiles&& other) noexcept
    : scan_(std::move(other.scan_)),
      folder_(std::exchange(other.folder_, {})),
      points_(std::move(other.points_)),
      read_seconds_(other.read_seconds_),
      converted_(std::move(other.converted_)),
      files_(std::move(other.files_)) {}

TradeFiles& TradeFiles::operator=(TradeFiles&& other) noexcept {
  std::swap(scan_, other.scan_);
  std::swap(folder_, other.folder_);
  std::swap(points_, other.points_);
  std::swap(read_seconds_, other.read_seconds_);
  std::swap(converted_, other.converted_);
  std::swap(files_, other.files_);
  return *this;
}

TradeFiles::~TradeFiles() {
  if (folder_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
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
  const std::filesystem::path path = folder_ / "setting.relief";
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
