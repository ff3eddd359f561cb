// The bound of the bench: shades a pixel for each pixel of the image, without finding out what it
// shows. Looks up one patch's maps, a cell a pixel, so that neighbours read neighbours as they do on a
// surface.
#include "include/counting.glsl"
#include "include/surface.glsl"

layout(location = RELIEF_UNIFORM_PATCH) uniform int shaded_patch;

void main() {
  count_fragment();
  PatchInfo info = fetch_patch(uint(shaded_patch));
  vec3 position = vec3(mod(gl_FragCoord.xy, max(vec2(info.nodes.xy - 1), 1.0)), 0.0);
  shade(info, position, ray_toward(position, fetch_eye(uint(shaded_patch))), 1.0,
        vec4(1.0, 0.0, 0.0, 1.0));
}
