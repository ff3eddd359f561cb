// Contexts of zstd, reused between frames: allocating them took half of the time of decoding small
// patches.
#pragma once

#include <memory>

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace relief {

/// For one thread at a time. Allocates on first use.
class ZstdContexts {
 public:
  ZstdContexts() = default;
  [[nodiscard]] ZSTD_CCtx_s* compression();
  [[nodiscard]] ZSTD_DCtx_s* decompression();

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
    void operator()(ZSTD_DCtx_s* context) const;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> compression_;
  std::unique_ptr<ZSTD_DCtx_s, Free> decompression_;
};

}  // namespace relief
