#include "preprocess/raster/gdal_file.h"

#include <cmath>
#include <utility>

#include "common/io/standard_input.h"

namespace relief {
namespace {

/// Formats of one file, or of one with small ones beside it (.hdr, .prj). No VRT and no services:
/// they name further files and addresses.
constexpr const char* kDrivers[] = {"GTiff", "USGSDEM", "AAIGrid", "SRTMHGT", "HFA",  "EHdr",
                                    "DTED",  "ENVI",    "PNG",     "JPEG",    nullptr};
constexpr unsigned kRaster = 0x02;

void ignore_error(int /*kind*/, int /*number*/, const char* /*text*/) {}

/// GDAL prints its errors while this lives not.
class QuietErrors {
 public:
  explicit QuietErrors(const Gdal& gdal) : gdal_(gdal) {
    gdal_.reset_errors();
    gdal_.push_error_handler(ignore_error);
  }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
  ~QuietErrors() { gdal_.pop_error_handler(); }

 private:
  const Gdal& gdal_;
};

/// What GDAL says, as a clause after a colon, in one line.
std::string reason(const Gdal& gdal) {
  std::string text = gdal.last_error();
  for (char& c : text) {
    if (c < ' ') c = ' ';
  }
  return text.empty() ? text : ": " + text;
}

}  // namespace

Result<GdalFile> GdalFile::open(const std::filesystem::path& path) {
  auto gdal = load_gdal();
  if (!gdal) return make_error("{}: {}", path.string(), gdal.error().message);
  std::error_code ignored;
  // Names of other kinds mean something else to GDAL (subdatasets, addresses).
  if (!std::filesystem::is_regular_file(input_path(path), ignored))
    return make_error("{}: there is no such file", path.string());
  const QuietErrors quiet(*gdal);
  const std::string full = std::filesystem::absolute(input_path(path)).string();
  GdalDataset const dataset = gdal->open_ex(full.c_str(), kRaster, kDrivers, nullptr, nullptr);
  if (dataset == nullptr) {
    return make_error(
        "{}: GDAL cannot open it as a GeoTIFF, USGS DEM, ASCII grid or another raster "
        "of one file{}",
        path.string(), reason(*gdal));
  }
  return GdalFile(*gdal, dataset, path.string());
}

GdalFile::GdalFile(GdalFile&& other) noexcept
    : gdal_(other.gdal_),
      dataset_(std::exchange(other.dataset_, nullptr)),
      name_(std::move(other.name_)) {}

GdalFile& GdalFile::operator=(GdalFile&& other) noexcept {
  std::swap(gdal_, other.gdal_);
  std::swap(dataset_, other.dataset_);
  std::swap(name_, other.name_);
  return *this;
}

GdalFile::~GdalFile() {
  if (dataset_ != nullptr) gdal_.close(dataset_);
}

bool GdalFile::has_coordinates() const {
  std::array<double, 6> unused{};
  const QuietErrors quiet(gdal_);
  return gdal_.geo_transform(dataset_, unused.data()) == 0;
}

Result<GeoGrid> GdalFile::grid(bool& is_flipped) const {
  std::array<double, 6> t{0.0, 1.0, 0.0, static_cast<double>(rows()), 0.0, -1.0};
  if (has_coordinates()) gdal_.geo_transform(dataset_, t.data());
  for (const double number : t) {
    if (!std::isfinite(number) || std::abs(number) > 1e100)
      return make_error("{}: its georeference is damaged: {} is no coordinate", name_, number);
  }
  if (t[2] != 0.0 || t[4] != 0.0 || t[1] <= 0.0 || t[5] == 0.0) {
    return make_error(
        "{}: its rows do not run from west to east; turn it with `gdalwarp IN OUT.tif`", name_);
  }
  GeoGrid grid;
  is_flipped = t[5] > 0.0;
  grid.dx = t[1];
  grid.dy = std::abs(t[5]);
  grid.x = t[0] + 0.5 * t[1];
  grid.y = t[3] + 0.5 * t[5] + (is_flipped ? t[5] * (rows() - 1.0) : 0.0);
  if (GdalSystem const s = system(); s != nullptr) {
    const char* const name = gdal_.system_name(s);
    grid.system = name == nullptr ? "" : name;
    grid.in_degrees = gdal_.is_geographic(s) != 0;
    int failed = 0;
    const double axis = gdal_.semi_major(s, &failed);
    if (failed == 0 && axis > 0.0) grid.semi_major = axis;
    const double flattening = gdal_.inverse_flattening(s, &failed);
    if (failed == 0 && (flattening == 0.0 || flattening > 1.0))
      grid.inverse_flattening = flattening;
  }
  if (grid.in_degrees &&
      !(std::abs(grid.y) <= 90.0 && std::abs(grid.y - (rows() - 1) * grid.dy) <= 90.0)) {
    return make_error("{}: is in degrees, but its latitudes reach from {} to {}", name_,
                      grid.y - (rows() - 1) * grid.dy, grid.y);
  }
  return grid;
}

Status GdalFile::read(int number, std::array<int, 4> window, void* buffer, int width, int height,
                      GdalType type) const {
  const QuietErrors quiet(gdal_);
  GdalReadOptions options;
  options.resampling = kGdalAverage;
  if (gdal_.read_ex(band(number), 0, window[0], window[1], window[2], window[3], buffer, width,
                    height, type, 0, 0, &options) != 0) {
    return make_error("{}: rows {} to {} cannot be read{}; the file is truncated or damaged", name_,
                      window[1], window[1] + window[3] - 1, reason(gdal_));
  }
  return {};
}

}  // namespace relief
