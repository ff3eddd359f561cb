#include "common/patch_file/fast/zstd_contexts.h"

#include <zstd.h>

#include <new>

namespace relief {

ZSTD_CCtx_s* ZstdContexts::compression() {
  if (compression_ == nullptr) compression_.reset(ZSTD_createCCtx());
  if (compression_ == nullptr) throw std::bad_alloc();
  return compression_.get();
}

ZSTD_DCtx_s* ZstdContexts::decompression() {
  if (decompression_ == nullptr) decompression_.reset(ZSTD_createDCtx());
  if (decompression_ == nullptr) throw std::bad_alloc();
  return decompression_.get();
}

void ZstdContexts::Free::operator()(ZSTD_CCtx_s* context) const {
  ZSTD_freeCCtx(context);
}

void ZstdContexts::Free::operator()(ZSTD_DCtx_s* context) const {
  ZSTD_freeDCtx(context);
}

}  // namespace relief
