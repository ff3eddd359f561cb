// A file opened through GDAL: georeferenced bands.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "common/error.h"
#include "preprocess/raster/gdal.h"
#include "preprocess/raster/geo_frame.h"

namespace relief {

/// An open data set. Errors begin with the file's name. Not thread-safe.
class GdalFile {
 public:
  /// Opens a file of a format that holds its own data: no file can make GDAL open another one far
  /// away, or reach the network.
  static Result<GdalFile> open(const std::filesystem::path& path);

  GdalFile(GdalFile&& other) noexcept;
  GdalFile& operator=(GdalFile&& other) noexcept;
  GdalFile(const GdalFile&) = delete;
  GdalFile& operator=(const GdalFile&) = delete;
  ~GdalFile();

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const Gdal& gdal() const { return gdal_; }
  [[nodiscard]] int columns() const { return gdal_.x_size(dataset_); }
  [[nodiscard]] int rows() const { return gdal_.y_size(dataset_); }
  [[nodiscard]] int bands() const { return gdal_.count(dataset_); }
  [[nodiscard]] GdalBand band(int number) const { return gdal_.band(dataset_, number); }
  /// Null if the file states none. Owned by the file.
  [[nodiscard]] GdalSystem system() const { return gdal_.spatial_ref(dataset_); }

  /// Returns whether the file states where it lies.
  [[nodiscard]] bool has_coordinates() const;
  /// Returns the grid of the cells' centres. Fails if the file is rotated or sheared, or its
  /// numbers are no numbers. Rows run from north to south; `is_flipped` if the file's run the other
  /// way.
  Result<GeoGrid> grid(bool& is_flipped) const;

  /// Reads a window of a band into a buffer of `width` x `height` values of `type`, averaged if it
  /// is smaller. Rows as in the file.
  Status read(int band, std::array<int, 4> window, void* buffer, int width, int height,
              GdalType type) const;

 private:
  GdalFile(const Gdal& gdal, GdalDataset dataset, std::string name)
      : gdal_(gdal), dataset_(dataset), name_(std::move(name)) {}

  Gdal gdal_;
  GdalDataset dataset_ = nullptr;
  std::string name_;
};

}  // namespace relief
