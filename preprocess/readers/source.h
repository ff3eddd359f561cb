// What every reader gets and gives: the bytes of one file, and the points in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// What a reader tells beside the points.
struct ReadRemarks {
  std::uint64_t left_out = 0;  ///< points that the file itself says not to use
  std::vector<std::string>
      notes;  ///< for the user, a sentence each that begins with the file's name
};

/// Takes a file's points block by block, where all of them together are too many for memory.
class PointSink {
 public:
  /// Enough that a block's columns and colours tell what they mean.
  static constexpr std::size_t kBlockPoints = std::size_t{1} << 16U;

  PointSink() = default;
  virtual ~PointSink() = default;
  PointSink(const PointSink&) = delete;
  PointSink& operator=(const PointSink&) = delete;

  /// The next points of the file, in its order.
  virtual Status take(Points block) = 0;
  /// Bytes before `offset` are not needed any more, unless the reader begins again.
  virtual void pass(std::size_t /*offset*/) {}
};

/// A scan's bytes, decompressed. They are not trusted.
struct Source {
  std::string name;       ///< path, with which each error begins
  std::string_view text;  ///< the whole file, text or not
  Progress& progress;
  ReadRemarks& remarks;
  /// Takes the points, if the format streams (see format.h); those that the reader returns come
  /// after them, and triangles are left out. Null: the reader returns all.
  PointSink* sink = nullptr;
};

/// Tells the progress how far a reader is, and the reader whether it shall stop. Cheap enough to be
/// asked for every line.
class ReadMeter {
 public:
  explicit ReadMeter(const Source& source) : progress_(source.progress), sink_(source.sink) {}

  /// `offset`: bytes read so far. False: return interrupted_error().
  [[nodiscard]] bool advance_to(std::size_t offset) {
    return offset < told_ + kStep || report(offset);
  }

 private:
  /// A megabyte of text takes about 10 ms.
  static constexpr std::size_t kStep = std::size_t{1} << 20U;

  [[nodiscard]] bool report(std::size_t offset) {
    progress_.advance(offset - told_);
    told_ = offset;
    if (sink_ != nullptr) sink_->pass(offset);
    return !progress_.cancelled();
  }

  Progress& progress_;
  PointSink* sink_;
  std::size_t told_ = 0;
};

/// `text` in quotes for a message: at most 24 characters, nothing that a terminal would obey.
[[nodiscard]] std::string quoted(std::string_view text);

/// `text` without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// `text` with ASCII letters in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Points can be indexed with 32 bits; the largest index stands for "no such point".
inline constexpr std::uint32_t kNoPoint = UINT32_MAX;

/// For a file with `count` >= kNoPoint points.
[[nodiscard]] Error too_many_points(const Source& source, std::uint64_t count);

}  // namespace relief
