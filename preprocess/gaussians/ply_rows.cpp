#include "preprocess/gaussians/ply_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "common/volume/gaussian_cloud.h"
#include "preprocess/readers/number_type.h"
#include "preprocess/readers/ply/ply_values.h"

namespace relief {
namespace {

/// Rows that are read at a time: of 62 numbers, 2 MB.
constexpr std::size_t kBlockRows = 4096;

bool has_lists(const PlyElement& element) {
  return std::ranges::any_of(element.properties,
                             [](const PlyProperty& p) { return p.count_type.has_value(); });
}

/// The bytes of a row, or the fewest if it is text: a digit and a separator for each number.
std::uint64_t row_size(const PlyElement& element, PlyEncoding encoding) {
  std::uint64_t size = 0;
  for (const PlyProperty& p : element.properties)
    size += encoding == PlyEncoding::Ascii ? PlyAsciiValues::min_size(p.type) : size_of(p.type);
  return size;
}

}  // namespace

const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
  const auto found = std::ranges::find(header.elements, name, &PlyElement::name);
  return found == header.elements.end() ? nullptr : &*found;
}

std::optional<std::size_t> find_property(const PlyElement& element, std::string_view name) {
  const auto found = std::ranges::find_if(
      element.properties, [name](const PlyProperty& p) { return p.name == name && !p.count_type; });
  if (found == element.properties.end()) return std::nullopt;
  return static_cast<std::size_t>(found - element.properties.begin());
}

Result<int> find_harmonics_degree(const Source& source, const PlyElement& element) {
  const auto count = static_cast<std::size_t>(std::ranges::count_if(
      element.properties, [](const PlyProperty& p) { return p.name.starts_with("f_rest_"); }));
  for (int degree = 0; degree <= kMaxHarmonicsDegree; ++degree) {
    if (count == 3 * (harmonics_of(degree) - 1)) return degree;
  }
  return make_error(
      "{}: has {} properties f_rest_0, f_rest_1 and so on, which is no degree of harmonics: "
      "expected 0, 9, 24, 45 or 72",
      source.name, count);
}

Result<PlyRows> PlyRows::find(const Source& source, const PlyHeader& header,
                              const PlyElement& element) {
  std::uint64_t left = source.text.size() - header.body;
  std::uint64_t before = 0;  // bytes of the rows before
  for (const PlyElement& e : header.elements) {
    if (has_lists(e)) {
      return make_error(
          "{}: its elements '{}' have lists before the Gaussians, which is not read; write it "
          "again without them",
          source.name, e.name);
    }
    const std::uint64_t size = row_size(e, header.encoding);
    // The last number of a text needs no separator.
    const std::uint64_t spare = header.encoding == PlyEncoding::Ascii ? 1 : 0;
    if (size > 0 && e.count > (left + spare) / size) {
      return make_error(
          "{}: the header states {} elements '{}', but the {} bytes after byte {} cannot hold "
          "them; the file is truncated or damaged",
          source.name, e.count, e.name, left, source.text.size() - left);
    }
    if (&e == &element) {
      return PlyRows(header, element, header.body + static_cast<std::size_t>(before));
    }
    left -= std::min(left, e.count * size);
    before += e.count * size;
  }
  return make_error("{}: has no elements '{}'", source.name, element.name);
}

Status PlyRows::add_column(const Source& source, std::string_view name) {
  const auto property = find_property(*element_, name);
  if (!property) {
    return make_error("{}: its elements '{}' have no property {}; write the scene again",
                      source.name, element_->name, name);
  }
  columns_.push_back(*property);
  return {};
}

template <bool BigEndian>
void PlyRows::read_block(std::string_view text, std::size_t first, std::size_t rows,
                         const TakeRows& take) const {
  std::vector<std::size_t> offsets;  // of the columns in a row
  std::vector<NumberType> types;
  for (const std::size_t column : columns_) {
    std::size_t offset = 0;
    for (std::size_t p = 0; p < column; ++p) offset += size_of(element_->properties[p].type);
    offsets.push_back(offset);
    types.push_back(element_->properties[column].type);
  }
  const std::size_t stride = row_size(*element_, header_->encoding);
  const char* row = text.data() + begin_ + first * stride;
  std::vector<double> numbers(rows * columns_.size());
  auto number = numbers.begin();
  for (std::size_t r = 0; r < rows; ++r, row += stride) {
    for (std::size_t c = 0; c < offsets.size(); ++c)
      *number++ = load_number<BigEndian>(types[c], row + offsets[c]);
  }
  take(first, numbers);
}

template <bool BigEndian>
Status PlyRows::read_binary(const Source& source, const TakeRows& take) const {
  const std::size_t stride = row_size(*element_, header_->encoding);
  const std::size_t blocks = (count() + kBlockRows - 1) / kBlockRows;
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    if (source.progress.cancelled()) return;
    const std::size_t first = block * kBlockRows;
    const std::size_t rows = std::min(kBlockRows, count() - first);
    read_block<BigEndian>(source.text, first, rows, take);
    source.progress.advance(rows * stride);
  });
  if (source.progress.cancelled()) return interrupted_error();
  return {};
}

Status PlyRows::read_ascii(const Source& source, const TakeRows& take) const {
  PlyAsciiValues values(source.text, header_->body);
  for (const PlyElement& e : header_->elements) {
    const bool is_wanted = &e == element_;
    std::size_t reported = values.offset();
    std::vector<double> row(e.properties.size());
    std::vector<double> numbers;
    for (std::uint64_t r = 0; r < e.count && !row.empty(); ++r) {
      bool is_read = values.begin_element();
      for (std::size_t p = 0; p < row.size() && is_read; ++p)
        is_read = values.value(e.properties[p].type, row[p]);
      if (!is_read || !values.end_element()) {
        return make_error("{}: {} ({} {} of {}); the file is truncated or damaged", source.name,
                          values.failure(), e.name, r + 1, e.count);
      }
      const bool ends_block = (r + 1) % kBlockRows == 0 || r + 1 == e.count;
      if (is_wanted) {
        for (const std::size_t column : columns_) numbers.push_back(row[column]);
        if (ends_block) take(static_cast<std::size_t>(r / kBlockRows * kBlockRows), numbers);
      }
      if (!ends_block) continue;
      numbers.clear();
      if (is_wanted) source.progress.advance(values.offset() - reported);
      reported = values.offset();
      if (source.progress.cancelled()) return interrupted_error();
    }
    if (is_wanted) break;
  }
  return {};
}

Status PlyRows::read(const Source& source, const TakeRows& take) const {
  switch (header_->encoding) {
    case PlyEncoding::Ascii:
      return read_ascii(source, take);
    case PlyEncoding::LittleEndian:
      return read_binary<false>(source, take);
    case PlyEncoding::BigEndian:
      return read_binary<true>(source, take);
  }
  return make_error("{}: unknown PLY encoding", source.name);
}

}  // namespace relief
