#include "common/patch_file/compact/height_predictor.h"

#include <bit>
#include <cassert>

namespace relief {
namespace {

#include "common/patch_file/compact/height_predictor_rows.inc"

}  // namespace

PredictorTable::PredictorTable(std::span<const PredictorRow> rows) : rows_(rows) {
  assert(rows.back().known == 0 && "the last row needs nothing");
  for (std::uint32_t known = 0; known < row_of_.size(); ++known) {
    std::size_t best = rows.size() - 1;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if ((rows[r].known & ~known) != 0) continue;
      const int more = std::popcount(rows[r].known) - std::popcount(rows[best].known);
      if (more > 0 || (more == 0 && rows[r].error < rows[best].error)) best = r;
    }
    row_of_[known] = static_cast<std::uint16_t>(best);
  }
}

const PredictorTables& predictor_tables() {
  static const PredictorTables tables{PredictorTable(kRowPassRows),
                                      PredictorTable(kColumnPassRows)};
  return tables;
}

}  // namespace relief
