// How fast the codecs of the patch file are, on one core: samples a second of heights and masks.
// usage: codec_speed FILE.relief...
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "common/patch_file/compact/compact_codec.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/patch_file.h"

using namespace relief;

namespace {

constexpr int kRounds = 9;

using Coded = std::vector<std::vector<std::byte>>;

/// Seconds that `work` takes.
template <class Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The best of all rounds of `encode` and `decode`, in seconds; false if decoding fails.
template <class Encode, class Decode>
bool measure(const std::vector<Patch>& patches, const Encode& encode, const Decode& decode,
             double& encoding, double& decoding) {
  bool is_right = true;
  encoding = decoding = 1e9;
  for (int round = 0; round < kRounds; ++round) {
    Coded coded(patches.size());
    encoding = std::min(encoding, seconds_of([&] {
                          for (std::size_t p = 0; p < patches.size(); ++p)
                            coded[p] = encode(patches[p]);
                        }));
    std::vector<Patch> read(patches.size());
    for (std::size_t p = 0; p < patches.size(); ++p) {
      read[p].width = patches[p].width;
      read[p].height = patches[p].height;
    }
    std::vector<std::uint32_t> samples;
    for (const Patch& patch : patches) {
      samples.push_back(static_cast<std::uint32_t>(count_samples(patch)));
    }
    decoding = std::min(decoding, seconds_of([&] {
                          for (std::size_t p = 0; p < patches.size(); ++p) {
                            if (!decode(coded[p], samples[p], read[p])) is_right = false;
                          }
                        }));
    for (std::size_t p = 0; p < patches.size(); ++p) {
      is_right = is_right && read[p].heights == patches[p].heights;
    }
  }
  return is_right;
}

}  // namespace

int main(int count, char** arguments) {
  for (int a = 1; a < count; ++a) {
    Progress progress;
    const auto file = PatchFile::open(arguments[a]);
    const auto model = file ? file->read_all(progress) : Result<PatchModel>(file.error());
    if (!model) {
      fmt::print(stderr, "{}\n", model.error().message);
      return 1;
    }
    const double millions = static_cast<double>(count_samples(*model)) / 1e6;
    ZstdContexts zstd;
    double encoding = 0.0;
    double decoding = 0.0;
    const bool fast = measure(
        model->patches, [&](const Patch& patch) { return encode_heights(patch, zstd); },
        [&](const auto& bytes, std::uint32_t samples, Patch& patch) {
          return static_cast<bool>(decode_heights(bytes, samples, patch, zstd));
        },
        encoding, decoding);
    fmt::print("{}: fast: encode {:.1f}, decode {:.1f} Msamples/s\n", arguments[a],
               millions / encoding, millions / decoding);
    const bool compact = measure(
        model->patches, [](const Patch& patch) { return encode_heights_compact(patch); },
        [](const auto& bytes, std::uint32_t samples, Patch& patch) {
          return static_cast<bool>(decode_heights_compact(bytes, samples, 0, patch));
        },
        encoding, decoding);
    fmt::print("{}: compact: encode {:.1f}, decode {:.1f} Msamples/s\n", arguments[a],
               millions / encoding, millions / decoding);
    if (!fast || !compact) {
      fmt::print(stderr, "{}: does not come back as it was\n", arguments[a]);
      return 1;
    }
  }
}
