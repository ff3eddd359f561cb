// Sheets of a regular grid in a texture: where they lie, and how wide kernels are in them.
#include "include/shared.h"
#include "volume/layout.h"

layout(std140, binding = RELIEF_VOLUME_BIND_GRID) uniform GridBlock { VolumeGrid grid; };
layout(std140, binding = RELIEF_VOLUME_BIND_SHEETS) uniform SheetsBlock { VolumeSheets sheets; };

/// The texel of a sheet's node (0, 0).
ivec2 origin_of_sheet(int sheet) {
  return ivec2(sheet % sheets.atlas.x, sheet / sheets.atlas.x) * sheets.atlas.yz + sheets.atlas.w;
}
