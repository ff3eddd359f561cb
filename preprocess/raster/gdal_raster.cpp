#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "preprocess/raster/gdal_file.h"
#include "preprocess/raster/raster.h"

namespace relief {
namespace {

bool is_whole(int type) {
  // GDT_UInt64, GDT_Int64 and GDT_Int8 are 12 to 14.
  return (type >= GdalType::Byte && type <= GdalType::Int32) || (type >= 12 && type <= 14);
}

/// Metres of a unit of heights, by its name; nothing if it is unknown or not stated.
std::optional<double> metres_of(const char* name) {
  const std::map<std::string, double> units = {{"m", 1.0},
                                               {"metre", 1.0},
                                               {"metres", 1.0},
                                               {"meter", 1.0},
                                               {"meters", 1.0},
                                               {"ft", 0.3048},
                                               {"foot", 0.3048},
                                               {"feet", 0.3048},
                                               {"us-ft", 1200.0 / 3937.0},
                                               {"cm", 0.01},
                                               {"US survey foot", 1200.0 / 3937.0}};
  const auto found = units.find(name == nullptr ? "" : name);
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

class GdalRaster final : public HeightRaster {
 public:
  GdalRaster(GdalFile file, RasterInfo info, bool is_flipped)
      : file_(std::move(file)), info_(std::move(info)), is_flipped_(is_flipped) {
    const Gdal& gdal = file_.gdal();
    int is_set = 0;
    const double no_data = gdal.no_data(band(), &is_set);
    if (is_set != 0) no_data_ = no_data;
    const double scale = gdal.scale(band(), &is_set);
    if (is_set != 0 && scale != 0.0) scale_ = scale;
    const double offset = gdal.offset(band(), &is_set);
    if (is_set != 0) offset_ = offset;
    if (is_whole(gdal.type(band()))) {
      info_.step = std::abs(scale_);
      info_.offset = offset_;
    }
  }

  [[nodiscard]] const RasterInfo& info() const override { return info_; }

  Status read(const RasterWindow& window, std::span<double> heights) override {
    const auto w = static_cast<int>(window.columns);
    const auto h = static_cast<int>(window.rows);
    const int first =
        is_flipped_ ? static_cast<int>(info_.rows - window.row) - h : static_cast<int>(window.row);
    RELIEF_TRY(file_.read(1, {static_cast<int>(window.column), first, w, h}, heights.data(), w, h,
                          GdalType::Double));
    for (double& value : heights) {
      const bool is_hole = !std::isfinite(value) || value == no_data_;
      value = is_hole ? std::numeric_limits<double>::quiet_NaN() : value * scale_ + offset_;
    }
    if (is_flipped_) {
      for (int row = 0; row < h / 2; ++row)
        std::swap_ranges(heights.begin() + std::ptrdiff_t{row} * w,
                         heights.begin() + std::ptrdiff_t{row + 1} * w,
                         heights.begin() + std::ptrdiff_t{h - 1 - row} * w);
    }
    return {};
  }

 private:
  [[nodiscard]] GdalBand band() const { return file_.band(1); }

  GdalFile file_;
  RasterInfo info_;
  bool is_flipped_;
  /// Never equal to a height without one.
  double no_data_ = std::numeric_limits<double>::quiet_NaN();
  double scale_ = 1.0;
  double offset_ = 0.0;
};

}  // namespace

Result<std::unique_ptr<HeightRaster>> open_gdal_raster(const std::filesystem::path& path) {
  RELIEF_TRY_ASSIGN(auto file, GdalFile::open(path));
  const int bands = file.bands();
  if (bands != 1) {
    return make_error("{}: has {} bands, but a raster of heights has one{}", file.name(), bands,
                      bands >= 3 ? "; a photograph is laid over heights with --texture" : "");
  }
  RasterInfo info;
  info.name = file.name();
  info.columns = static_cast<std::uint32_t>(file.columns());
  info.rows = static_cast<std::uint32_t>(file.rows());
  if (info.columns < 2 || info.rows < 2)
    return make_error("{}: has {} x {} cells; heights need at least 2 x 2", info.name, info.columns,
                      info.rows);
  bool is_flipped = false;
  info.has_coordinates = file.has_coordinates();
  RELIEF_TRY_ASSIGN(info.grid, file.grid(is_flipped));
  const auto unit = metres_of(file.gdal().unit(file.band(1)));
  double metres = 1.0;
  GdalSystem const system = file.system();
  if (system != nullptr && !info.grid.in_degrees)
    metres = file.gdal().linear_units(system, nullptr);
  // Without a stated unit heights are in metres over degrees, and in the unit of x and y elsewhere.
  if (unit && system != nullptr && metres > 0.0) info.height_unit = *unit / metres;
  return std::unique_ptr<HeightRaster>(
      std::make_unique<GdalRaster>(std::move(file), std::move(info), is_flipped));
}

}  // namespace relief
