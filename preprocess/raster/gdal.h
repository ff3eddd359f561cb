// GDAL's C functions, opened while running.
//
// Linking libgdal would load its hundred libraries whenever `relief` starts (0.15 s,
// docs/decisions/0108). Its C functions and their types have been stable since GDAL 2.
#pragma once

#include <string>

#include "common/error.h"

namespace relief {

/// GDAL's handles; the library owns what they point to.
using GdalDataset = void*;
using GdalBand = void*;
using GdalSystem = void*;

/// GDALDataType.
enum GdalType : int { Byte = 1, Uint16 = 2, Int16 = 3, Uint32 = 4, Int32 = 5, Double = 7 };

/// GDALRasterIOExtraArg, version 1.
struct GdalReadOptions {
  int version = 1;
  int resampling = 0;
  int (*progress)(double, const char*, void*) = nullptr;
  void* progress_data = nullptr;
  int has_exact_window = 0;
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
};
inline constexpr int kGdalAverage = 5;  ///< GRIORA_Average

/// The functions that are called, named as in GDAL without their prefix.
struct Gdal {
  void (*all_register)();
  GdalDataset (*open_ex)(const char*, unsigned, const char* const*, const char* const*,
                         const char* const*);
  int (*close)(GdalDataset);
  int (*x_size)(GdalDataset);
  int (*y_size)(GdalDataset);
  int (*count)(GdalDataset);
  GdalBand (*band)(GdalDataset, int);
  int (*geo_transform)(GdalDataset, double*);
  GdalSystem (*spatial_ref)(GdalDataset);
  int (*type)(GdalBand);
  double (*no_data)(GdalBand, int*);
  double (*scale)(GdalBand, int*);
  double (*offset)(GdalBand, int*);
  const char* (*unit)(GdalBand);
  void* (*colour_table)(GdalBand);
  int (*colour_count)(void*);
  const short* (*colour_entry)(void*, int);
  int (*read_ex)(GdalBand, int, int, int, int, int, void*, int, int, int, long long, long long,
                 GdalReadOptions*);
  int (*is_geographic)(GdalSystem);
  int (*is_same)(GdalSystem, GdalSystem);
  double (*semi_major)(GdalSystem, int*);
  double (*inverse_flattening)(GdalSystem, int*);
  double (*linear_units)(GdalSystem, char**);
  const char* (*system_name)(GdalSystem);
  void (*set_option)(const char*, const char*);
  void (*push_error_handler)(void (*)(int, int, const char*));
  void (*pop_error_handler)();
  const char* (*last_error)();
  void (*reset_errors)();
};

/// Opens the library and registers its drivers. Fails with a clause that names the package.
Result<Gdal> load_gdal();

/// Returns whether load_gdal would succeed, for tests.
[[nodiscard]] bool has_gdal();

}  // namespace relief
