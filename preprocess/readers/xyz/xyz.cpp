#include <optional>
#include <span>
#include <string>
#include <utility>

#include "preprocess/readers/point_record.h"
#include "preprocess/readers/readers.h"
#include "preprocess/readers/text_cursor.h"
#include "preprocess/readers/xyz/xyz_columns.h"

namespace relief {
namespace {

/// Tables with more columns are grids of heights, not points.
constexpr std::size_t kMaxColumns = 24;
/// A text without numbers in so many lines is not a list of points.
constexpr std::size_t kMaxHeaderLines = 100;

bool is_comment(std::string_view word) {
  return word.starts_with('#') || word.starts_with("//") || word.starts_with('%');
}

class XyzReader {
 public:
  explicit XyzReader(const Source& source) : source_(source), line_(source.text, " \t\f\v,;") {}

  Result<Points> read() {
    ReadMeter meter(source_);
    while (line_.next_line()) {
      if (!meter.advance_to(line_.offset())) return interrupted_error();
      RELIEF_TRY(read_line());
    }
    const std::uint64_t rows = given_ + table_.rows();
    if (rows == 0) return make_error("{}: holds no points", source_.name);
    if (stated_ > rows) {
      return make_error("{}: states {} points, but has {}; the file is truncated", source_.name,
                        stated_, rows);
    }
    if (rows >= kNoPoint) return too_many_points(source_, rows);
    collect();
    return collector_->finish();
  }

 private:
  Status read_line() {
    double first = 0.0;
    const bool begun = table_.columns != 0;
    if (is_comment(line_.peek()) || (!begun && !parse_number(line_.peek(), first))) {
      return begun ? Status{} : read_header_line();
    }
    if (!begun && has_decimal_commas()) {
      return make_error("{}: line {}: the numbers have decimal commas; write them with points",
                        source_.name, line_.line_number());
    }
    double numbers[kMaxColumns];
    std::size_t count = 0;
    while (!line_.at_line_end()) {
      if (count == kMaxColumns) {
        return make_error("{}: line {}: has more than {} columns, so it is not a list of points",
                          source_.name, line_.line_number(), kMaxColumns);
      }
      if (!line_.number(numbers[count])) {
        return make_error("{}: {}; the file is damaged or not a list of points", source_.name,
                          line_.expected("a number"));
      }
      ++count;
    }
    return take_row({numbers, count});
  }

  /// A line above the numbers; the last of them may name the columns.
  Status read_header_line() {
    if (++header_lines_ > kMaxHeaderLines) {
      return make_error("{}: the first {} lines have no numbers, so it is not a list of points",
                        source_.name, kMaxHeaderLines);
    }
    names_ = line_.rest_of_line();
    if (lower_case(names_.substr(0, 5)) == "ncols") {
      return make_error("{}: is a grid of heights (ESRI ASCII), not a list of points",
                        source_.name);
    }
    return {};
  }

  /// 1,5;2,5;3,5 or 1,5 2,5 3,5: commas before digits, other separators after digits, no points.
  bool has_decimal_commas() {
    TextCursor line = line_;
    const std::string_view text = line.rest_of_line();
    const auto is_digit = [&](std::size_t i) {
      return i < text.size() && text[i] >= '0' && text[i] <= '9';
    };
    bool comma = false;
    bool other = false;
    for (std::size_t i = 1; i < text.size(); ++i) {
      comma |= text[i] == ',' && is_digit(i + 1);
      other |= (text[i] == ';' || text[i] == ' ' || text[i] == '\t') && is_digit(i - 1);
    }
    return comma && other && text.find('.') == text.npos;
  }

  Status take_row(std::span<const double> row) {
    // A line with a single number is the number of following points, as in .pts files.
    if (row.size() == 1) {
      if (!(row[0] >= 0.0 && row[0] < static_cast<double>(kNoPoint))) {
        return make_error("{}: line {}: expected a point or a number of points", source_.name,
                          line_.line_number());
      }
      stated_ += static_cast<std::uint64_t>(row[0]);
      return {};
    }
    if (table_.columns == 0) table_.columns = row.size();
    if (row.size() != table_.columns || row.size() < 3) {
      return make_error(
          "{}: line {}: expected {} numbers, found {}; the file is truncated or damaged",
          source_.name, line_.line_number(),
          table_.columns < 3 ? "3 or more" : std::to_string(table_.columns), row.size());
    }
    table_.numbers.insert(table_.numbers.end(), row.begin(), row.end());
    if (source_.sink == nullptr || table_.rows() < PointSink::kBlockPoints) return {};
    collect();
    return collector_->give_block(source_);
  }

  /// Moves the table's rows to the collector. The first rows determine the meaning of the columns.
  void collect() {
    if (!collector_) find_columns();
    PointRecord record{};
    for (std::size_t i = 0; i < table_.rows(); ++i) {
      for (std::size_t c = 0; c < table_.columns; ++c) record[roles_[c]] = table_.row(i)[c];
      collector_->add(record);
    }
    given_ += table_.rows();
    table_.numbers.clear();
  }

  void find_columns() {
    const std::string path = lower_case(source_.name);
    std::string_view name = path;
    if (name.ends_with(".gz")) name.remove_suffix(3);
    const std::size_t dot = name.rfind('.');
    const std::string_view extension = dot == name.npos ? "" : name.substr(dot);
    ColumnRoles found = find_column_roles(table_, names_, extension);
    RecordLayout layout;
    for (std::size_t c = 0; c < found.roles.size(); ++c) {
      found.roles[c] = found.roles[c] == Other ? layout.add(found.names[c], source_)
                                               : layout.add(found.roles[c]);
    }
    collector_.emplace(layout, found.colour_numbers, table_.rows());
    roles_ = std::move(found.roles);
  }

  const Source& source_;
  TextCursor line_;
  NumberTable table_;
  std::optional<PointCollector> collector_;  ///< once the columns are known
  std::vector<Role> roles_;                  ///< per column
  std::uint64_t given_ = 0;                  ///< rows that the collector has had
  std::string_view names_;
  std::size_t header_lines_ = 0;
  std::uint64_t stated_ = 0;
};

}  // namespace

Result<Points> read_xyz(const Source& source) {
  return XyzReader(source).read();
}

}  // namespace relief
