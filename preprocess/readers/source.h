// The input of all readers, and helpers for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"
#include "common/scalars/scalar_names.h"
#include "preprocess/points/no_point.h"
#include "preprocess/readers/selection.h"

namespace relief {

/// The remarks of a reader beside the points.
struct ReadRemarks {
  std::uint64_t left_out = 0;      ///< points that the file marks as not to be used
  std::uint64_t not_selected = 0;  ///< points of other classes or returns than the selection's
  std::vector<std::string>
      notes;  ///< for the user, a sentence each that begins with the file's name
  std::vector<std::string> scalars;  ///< canonical names of all that the file has
};

/// Receives a file's points block by block, for scans larger than memory.
class PointSink {
 public:
  /// Enough to recognise the meaning of columns and the range of colours in one block.
  static constexpr std::size_t kBlockPoints = std::size_t{1} << 16U;

  PointSink() = default;
  virtual ~PointSink() = default;
  PointSink(const PointSink&) = delete;
  PointSink& operator=(const PointSink&) = delete;

  /// Receives the next points of the file, in its order.
  virtual Status take(Points block) = 0;
  /// Called when bytes before `offset` are no longer needed, unless the reader starts again.
  virtual void pass(std::size_t /*offset*/) {}
};

/// A file's decompressed bytes. They are not trusted.
struct Source {
  std::string name;       ///< path, with which each error begins
  std::string_view text;  ///< the whole file, text or not
  Progress& progress;
  ReadRemarks& remarks;
  /// Receives the points if the format streams (see format.h); the reader then returns the last
  /// ones, and triangles are left out. Null: the reader returns all points.
  PointSink* sink = nullptr;
  /// Classes and returns of formats that have them (see format.h). Null: all points.
  const PointSelection* selected = nullptr;
  const ScalarChoice* scalars = nullptr;  ///< those to keep; null: none

  [[nodiscard]] const PointSelection& selection() const;

  /// Adds a scalar to the remarks, and returns whether to keep it. A second one of a name, and
  /// those beyond kMaxScalars, are not kept.
  [[nodiscard]] bool takes_scalar(const std::string& canonical) const;
};

/// Fails unless a file has the scalars that are asked for by name. `name` begins the error.
Status check_scalars(const std::string& name, const ScalarChoice& choice,
                     const ReadRemarks& remarks);

/// Makes numbers that are infinite none: NaN.
void drop_infinite(std::vector<PointScalar>& scalars);

/// Reports a reader's progress, and whether to stop. Cheap enough to call for every line.
class ReadMeter {
 public:
  explicit ReadMeter(const Source& source) : progress_(source.progress), sink_(source.sink) {}

  /// `offset`: bytes read so far. If it returns false, return interrupted_error().
  [[nodiscard]] bool advance_to(std::size_t offset) {
    return offset < reported_ + kStep || report(offset);
  }

 private:
  /// A megabyte of text takes about 10 ms.
  static constexpr std::size_t kStep = std::size_t{1} << 20U;

  [[nodiscard]] bool report(std::size_t offset) {
    progress_.advance(offset - reported_);
    reported_ = offset;
    if (sink_ != nullptr) sink_->pass(offset);
    return !progress_.cancelled();
  }

  Progress& progress_;
  PointSink* sink_;
  std::size_t reported_ = 0;
};

/// Returns `text` in quotes for a message: at most 24 characters, without control characters.
[[nodiscard]] std::string quoted(std::string_view text);

/// Returns `text` without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Returns `text` with ASCII letters in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Returns the error for a file with `count` >= kNoPoint points.
[[nodiscard]] Error too_many_points(const Source& source, std::uint64_t count);

}  // namespace relief
