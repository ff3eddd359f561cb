// Vertex stage of both passes over splats: which side of a splat the eye sees.
#if (RELIEF_FEATURES & RELIEF_FEATURE_SIDED) != 0u
layout(location = 12) flat out uint side;

// `along`: of the ray to the splat's centre, times its normal. Not gl_FrontFacing: both passes must
// agree on splats that are all but edge-on, or a pixel would be without weight.
void write_side(float along) {
  side = along < 0.0 ? 1u : 2u;
}
#else
void write_side(float along) {}
#endif
