// Reads an element of a PLY file as a table of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "preprocess/readers/ply/ply_header.h"
#include "preprocess/readers/source.h"

namespace relief {

/// Returns the element with this name; null if there is none.
[[nodiscard]] const PlyElement* find_element(const PlyHeader& header, std::string_view name);

/// Returns the place of a property in its element that is a single number.
[[nodiscard]] std::optional<std::size_t> find_property(const PlyElement& element,
                                                       std::string_view name);

/// Returns the degree of the harmonics that an element has beyond degree 0: single numbers
/// f_rest_0, f_rest_1 and so on. Fails if their number fits no degree up to kMaxHarmonicsDegree.
Result<int> find_harmonics_degree(const Source& source, const PlyElement& element);

/// Receives some rows, of which `first` is the first one's number. `numbers`: their columns, row by
/// row.
using TakeRows = std::function<void(std::size_t first, std::span<const double> numbers)>;

/// The rows of one element without lists.
class PlyRows {
 public:
  /// Finds the rows of an element of `header`, which must outlive them. Fails if the bytes after
  /// the header cannot hold them and those before, or if one of these elements has lists.
  static Result<PlyRows> find(const Source& source, const PlyHeader& header,
                              const PlyElement& element);

  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(element_->count); }

  /// Adds the column of a property. Fails if the element has no such number.
  Status add_column(const Source& source, std::string_view name);

  /// Reads the columns of all rows and passes them to `take`: in several threads at once if the
  /// file is binary. Advances the progress by the bytes.
  Status read(const Source& source, const TakeRows& take) const;

 private:
  PlyRows(const PlyHeader& header, const PlyElement& element, std::size_t begin)
      : header_(&header), element_(&element), begin_(begin) {}

  template <bool BigEndian>
  void read_block(std::string_view text, std::size_t first, std::size_t rows,
                  const TakeRows& take) const;
  template <bool BigEndian>
  Status read_binary(const Source& source, const TakeRows& take) const;
  Status read_ascii(const Source& source, const TakeRows& take) const;

  const PlyHeader* header_;
  const PlyElement* element_;
  std::size_t begin_;                 ///< offset of the first row, if the file is binary
  std::vector<std::size_t> columns_;  ///< properties
};

}  // namespace relief
