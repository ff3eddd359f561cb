// What zstd allocates for a frame, kept for the next one: half of the time that small patches took
// to decode went into allocating it.
#pragma once

#include <memory>

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace relief {

/// For one thread at a time. Allocates when it is first asked.
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
