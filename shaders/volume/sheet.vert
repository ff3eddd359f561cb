// A square of a sheet's texels, as a point.
#include "volume/sheets.glsl"

/// First node along u and v, sheet.
layout(binding = RELIEF_VOLUME_TEXTURE_TILES) uniform isamplerBuffer tiles;

flat out ivec3 origin;  ///< texel of the sheet's node (0, 0); the sheet

void main() {
  ivec4 tile = texelFetch(tiles, gl_VertexID);
  origin = ivec3(origin_of_sheet(tile.z), tile.z);
  vec2 middle = vec2(origin.xy + tile.xy) + 0.5 * float(kVolumeSheetTile);
  gl_Position = vec4(2.0 * middle / sheets.texture.xy - 1.0, 0.0, 1.0);
  gl_PointSize = float(kVolumeSheetTile);
}
