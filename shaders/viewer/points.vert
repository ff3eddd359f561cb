// The points of a scan, before its patches are there.
#include "include/shared.h"

layout(std140, binding = RELIEF_BIND_FRAME) uniform Block { PointFrame frame; };

layout(location = RELIEF_ATTRIBUTE_POSITION) in vec3 position;
layout(location = RELIEF_ATTRIBUTE_COLOUR) in vec4 colour;

out vec3 shown_colour;

void main() {
  gl_Position = frame.clip_from_points * vec4(position, 1.0);
  gl_PointSize = clamp(frame.size.x / gl_Position.w, frame.size.y, frame.size.z);
  shown_colour = mix(colour.rgb / 12.92, pow((colour.rgb + 0.055) / 1.055, vec3(2.4)),
                     greaterThan(colour.rgb, vec3(0.04045)));
}
