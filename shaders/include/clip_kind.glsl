// Fragment stage of pass 1: the output that says how the splat in front is clipped.
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_CLIP) != 0u
layout(location = RELIEF_OUT_CLIP) out uint out_clip;

void write_clip_kind() {
  out_clip = clip_range.y & kClipKindMask;
}
#else
void write_clip_kind() {}
#endif
