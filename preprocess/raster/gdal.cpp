#include "preprocess/raster/gdal.h"

#include <dlfcn.h>

#include <utility>

namespace relief {
namespace {

/// From Debian 12 (32), Ubuntu 24.04 (34) and Debian 13 (36) on; older ones have not been tried.
constexpr int kOldestLibrary = 32;
constexpr int kNewestLibrary = 45;

void* open_library() {
  // NODELETE: GDAL has state of its own until the process ends.
  constexpr int flags = RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE;
  for (int version = kNewestLibrary; version >= kOldestLibrary; --version) {
    const std::string name = "libgdal.so." + std::to_string(version);
    if (void* const library = ::dlopen(name.c_str(), flags); library != nullptr) return library;
  }
  return ::dlopen("libgdal.so", flags);
}

/// Returns the first function that the library lacks; empty if it has all.
std::string take_functions(void* library, Gdal& gdal) {
  std::string missing;
  const auto take = [&](auto& function, const char* name) {
    void* const found = ::dlsym(library, name);
    if (found == nullptr && missing.empty()) missing = name;
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(found);
  };
  take(gdal.all_register, "GDALAllRegister");
  take(gdal.open_ex, "GDALOpenEx");
  take(gdal.close, "GDALClose");
  take(gdal.x_size, "GDALGetRasterXSize");
  take(gdal.y_size, "GDALGetRasterYSize");
  take(gdal.count, "GDALGetRasterCount");
  take(gdal.band, "GDALGetRasterBand");
  take(gdal.geo_transform, "GDALGetGeoTransform");
  take(gdal.spatial_ref, "GDALGetSpatialRef");
  take(gdal.type, "GDALGetRasterDataType");
  take(gdal.no_data, "GDALGetRasterNoDataValue");
  take(gdal.scale, "GDALGetRasterScale");
  take(gdal.offset, "GDALGetRasterOffset");
  take(gdal.unit, "GDALGetRasterUnitType");
  take(gdal.colour_table, "GDALGetRasterColorTable");
  take(gdal.colour_count, "GDALGetColorEntryCount");
  take(gdal.colour_entry, "GDALGetColorEntry");
  take(gdal.read_ex, "GDALRasterIOEx");
  take(gdal.is_geographic, "OSRIsGeographic");
  take(gdal.is_same, "OSRIsSame");
  take(gdal.semi_major, "OSRGetSemiMajor");
  take(gdal.inverse_flattening, "OSRGetInvFlattening");
  take(gdal.linear_units, "OSRGetLinearUnits");
  take(gdal.system_name, "OSRGetName");
  take(gdal.set_option, "CPLSetConfigOption");
  take(gdal.push_error_handler, "CPLPushErrorHandler");
  take(gdal.pop_error_handler, "CPLPopErrorHandler");
  take(gdal.last_error, "CPLGetLastErrorMsg");
  take(gdal.reset_errors, "CPLErrorReset");
  return missing;
}

}  // namespace

Result<Gdal> load_gdal() {
  void* const library = open_library();
  if (library == nullptr) {
    return Error{
        "rasters are read through GDAL, which is not installed; install the package gdal-bin, or "
        "convert the raster to a CSV of heights"};
  }
  Gdal gdal{};
  if (const std::string missing = take_functions(library, gdal); !missing.empty())
    return make_error("the installed GDAL has no function {}; install another version", missing);
  // Reading must not write .aux.xml files beside the raster.
  gdal.set_option("GDAL_PAM_ENABLED", "NO");
  gdal.all_register();
  return gdal;
}

bool has_gdal() {
  return open_library() != nullptr;
}

}  // namespace relief
