// Fragment stage of pass 1 over splats: the side of the one in front that the eye sees.
#if (RELIEF_FEATURES & RELIEF_FEATURE_SIDED) != 0u
layout(location = 12) flat in uint side;
layout(location = RELIEF_OUT_SIDE) out uint out_side;

void write_side_in_front() {
  out_side = side;
}
#else
void write_side_in_front() {}
#endif
