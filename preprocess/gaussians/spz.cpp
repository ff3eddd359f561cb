#include <zstd.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "common/guard.h"
#include "preprocess/gaussians/gaussian_readers.h"
#include "preprocess/gaussians/spz_gaussians.h"
#include "preprocess/readers/gzip/gunzip.h"
#include "preprocess/readers/gzip/inflate.h"

namespace relief {
namespace {

/// The ratio of decompressed to compressed bytes, in files of more than kAnyRatioBytes
/// (gunzip.h). Centres are noise that hardly packs; if all other streams were of zeros, the ratio
/// would be about 10 (degree 4: 92 bytes, of which 9).
constexpr std::uint64_t kMostPackedRatio = 32;
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr std::uint64_t kAnyPackedBytes = std::uint64_t{1} << 20U;
#else
constexpr std::uint64_t kAnyPackedBytes = kAnyRatioBytes;
#endif
/// More extensions than this are not read; those that are known have at most 20 bytes.
constexpr std::size_t kMostExtensionBytes = std::size_t{64} << 10U;
/// Version 4: the header goes on with the offset of the table of contents and 12 unused bytes.
constexpr std::size_t kStreamsHeaderBytes = 32;
/// In the table of contents: two numbers of 8 bytes, the compressed and the decompressed size.
constexpr std::size_t kEntryBytes = 16;
/// Bytes that are decompressed at a time.
constexpr std::size_t kPieceBytes = std::size_t{4} << 20U;

std::span<const std::byte> bytes_of(const Source& source) {
  return std::as_bytes(std::span(source.text));
}

/// Returns the bytes of all streams. Fails if a file of this size can't decompress to them.
Result<std::size_t> streams_size(const Source& source, const SpzHeader& header) {
  const std::uint64_t size = std::uint64_t{header.count} * spz_sizes(header).sum();
  if (size > std::max(kAnyPackedBytes, kMostPackedRatio * source.text.size())) {
    return make_error(
        "{}: states {} Gaussians, which are {} MB, but has only {} bytes; the file is truncated or "
        "damaged",
        source.name, header.count, size / 1'000'000, source.text.size());
  }
  return static_cast<std::size_t>(size);
}

/// What is decompressed of a file of versions 1 to 3.
struct PlainSpz {
  SpzHeader header;
  std::vector<std::byte> bytes;  ///< with the header
};

/// Decompresses as much as the header states, and extensions.
Result<PlainSpz> unpack_gzip(const Source& source) {
  PlainSpz plain;
  std::size_t most = 0;
  std::size_t reported = 0;
  RELIEF_TRY(inflate_pieces(
      source.name, bytes_of(source), DeflateForm::Gzip, source.progress,
      [&](std::span<const std::byte> piece, std::size_t used) -> Result<bool> {
        plain.bytes.insert(plain.bytes.end(), piece.begin(), piece.end());
        source.progress.advance(used - std::exchange(reported, used));
        if (most == 0 && plain.bytes.size() >= SpzHeader::kBytes) {
          RELIEF_TRY_ASSIGN(plain.header, read_spz_header(source.name, plain.bytes));
          RELIEF_TRY_ASSIGN(const std::size_t size, streams_size(source, plain.header));
          most = SpzHeader::kBytes + size + kMostExtensionBytes;
          // Half of what usual files decompress to; memory grows with the data.
          plain.bytes.reserve(std::min(most, 2 * source.text.size()));
        }
        return most == 0 || plain.bytes.size() < most;
      }));
  if (most == 0) {
    RELIEF_TRY_ASSIGN(plain.header, read_spz_header(source.name, plain.bytes));
  }
  return plain;
}

/// Versions 1 to 3, decompressed: the header, the streams, extensions.
Result<GaussianCloud> decode_plain(const Source& source, const SpzHeader& header,
                                   std::span<const std::byte> bytes) {
  if (header.version >= kSpzStreamsVersion) {
    return make_error("{}: is of version {} of .spz, but packed with gzip as those up to {}",
                      source.name, header.version, kSpzStreamsVersion - 1);
  }
  RELIEF_TRY_ASSIGN(const std::size_t size, streams_size(source, header));
  const auto body = bytes.subspan(SpzHeader::kBytes);
  if (body.size() < size) {
    return make_error("{}: its {} Gaussians need {} bytes, but there are {}; the file is truncated",
                      source.name, header.count, size, body.size());
  }
  AxisSigns axes(1.0F);
  if (header.has_extensions) {
    RELIEF_TRY_ASSIGN(axes, read_spz_axes(source.name, body.subspan(size)));
  }
  return decode_spz(source, header, axes, body.first(size));
}

using ZstdStream = std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)>;

/// Decompresses a stream, which must fill `out`.
Status unpack_stream(const Source& source, ZSTD_DStream* zstd, std::span<const std::byte> packed,
                     std::span<std::byte> out) {
  ZSTD_initDStream(zstd);
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::size_t done = 0;
  std::size_t state = 1;  // 0: a frame has ended
  while (done < out.size() || (state != 0 && in.pos < in.size)) {
    if (source.progress.cancelled()) return interrupted_error();
    const std::size_t in_before = in.pos;
    ZSTD_outBuffer piece{out.data() + done, std::min(kPieceBytes, out.size() - done), 0};
    state = ZSTD_decompressStream(zstd, &piece, &in);
    if (ZSTD_isError(state) != 0U) {
      return make_error("{}: a compressed stream is damaged ({})", source.name,
                        ZSTD_getErrorName(state));
    }
    done += piece.pos;
    source.progress.advance(in.pos - in_before);
    if (piece.pos == 0 && in.pos == in_before) break;  // the stream wants more of either
  }
  if (done < out.size() || state != 0 || in.pos < in.size) {
    return make_error(
        "{}: a compressed stream does not hold the {} bytes that the table of contents states; the "
        "file is damaged",
        source.name, out.size());
  }
  return {};
}

/// Version 4: the header, extensions, the table of contents, the streams.
Result<GaussianCloud> read_streams(const Source& source, const SpzHeader& header) {
  const auto bytes = bytes_of(source);
  if (bytes.size() < kStreamsHeaderBytes) {
    return make_error("{}: ends within its header; the file is truncated", source.name);
  }
  const std::size_t table = ByteReader(bytes.subspan(SpzHeader::kBytes)).take<std::uint32_t>();
  const SpzSizes sizes = spz_sizes(header);
  std::vector<std::size_t> parts = {sizes.centres, sizes.opacities, sizes.colours, sizes.scales,
                                    sizes.rotations};
  if (sizes.harmonics > 0) parts.push_back(sizes.harmonics);
  if (header.streams != parts.size()) {
    return make_error("{}: has {} streams, but its Gaussians need {}; the header is damaged",
                      source.name, header.streams, parts.size());
  }
  const std::size_t table_bytes = parts.size() * kEntryBytes;
  if (table < kStreamsHeaderBytes || table > bytes.size() || table_bytes > bytes.size() - table) {
    return make_error(
        "{}: its table of contents is at byte {} of {}; the file is truncated or damaged",
        source.name, table, bytes.size());
  }
  AxisSigns axes(1.0F);
  if (header.has_extensions) {
    RELIEF_TRY_ASSIGN(axes, read_spz_axes(source.name, bytes.subspan(kStreamsHeaderBytes,
                                                                     table - kStreamsHeaderBytes)));
  }
  RELIEF_TRY_ASSIGN(const std::size_t size, streams_size(source, header));
  ByteReader entries(bytes.subspan(table, table_bytes));
  ByteReader packed(bytes.subspan(table + table_bytes));
  std::vector<std::byte> unpacked(size);
  auto left = std::span(unpacked);
  const ZstdStream zstd(ZSTD_createDStream(), &ZSTD_freeDStream);
  if (zstd == nullptr) {
    return make_error("{}: not enough memory to decompress it; {}", source.name, kMoreMemory);
  }
  for (const std::size_t part : parts) {
    const auto packed_size = entries.take<std::uint64_t>();
    const auto stated = entries.take<std::uint64_t>();
    const std::size_t wanted = part * header.count;
    if (stated != wanted) {
      return make_error(
          "{}: a stream is stated to hold {} bytes, but {} Gaussians need {}; the file is damaged",
          source.name, stated, header.count, wanted);
    }
    if (packed_size > packed.left()) {
      return make_error(
          "{}: a stream is stated to have {} bytes, but {} are left; the file is "
          "truncated or damaged",
          source.name, packed_size, packed.left());
    }
    RELIEF_TRY(unpack_stream(source, zstd.get(),
                             packed.take_bytes(static_cast<std::size_t>(packed_size)),
                             left.first(wanted)));
    left = left.subspan(wanted);
  }
  if (packed.left() > 0) {
    return make_error("{}: the streams are followed by {} bytes; the file is damaged", source.name,
                      packed.left());
  }
  return decode_spz(source, header, axes, unpacked);
}

}  // namespace

Result<GaussianCloud> read_spz(const Source& source) {
  const auto bytes = bytes_of(source);
  if (is_gzip(bytes)) {
    RELIEF_TRY_ASSIGN(const auto plain, unpack_gzip(source));
    return decode_plain(source, plain.header, plain.bytes);
  }
  RELIEF_TRY_ASSIGN(const auto header, read_spz_header(source.name, bytes));
  if (header.version >= kSpzStreamsVersion) return read_streams(source, header);
  return decode_plain(source, header, bytes);  // someone has decompressed it
}

}  // namespace relief
