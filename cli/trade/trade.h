// `relief bench --trade`: what speed, size and accuracy cost each other on a scan.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/trade/trade_answers.h"
#include "cli/trade/trade_bench.h"
#include "cli/trade/trade_row.h"
#include "common/error.h"
#include "common/progress.h"
#include "loader/scene/scene_plan.h"

namespace relief::cli {

struct TradeJob {
  std::filesystem::path truth;  ///< a mesh; empty: the scan's own faces, or its finest patches
  double seconds = 300.0;       ///< for all of it, about
  TradeRounds rounds;           ///< of each setting
  TradeRounds final_rounds;     ///< of those near the front, at the end
  std::vector<TradeQuestion> questions;
};

struct TradeAnswer {
  TradeQuestion question;
  std::optional<std::size_t> row;
  std::string why_not;  ///< if there is no row
};

struct TradeReport {
  std::string scan;
  std::string renderer;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Material material = Material::Lit;
  TradeTruth truth_is = TradeTruth::Faces;
  std::string truth;  ///< the file's name, if it is one
  std::uint64_t truth_triangles = 0;
  std::uint64_t points = 0;
  double seconds = 0.0;
  std::size_t single_changes = 0;     ///< settings that differ from the default in one knob
  bool tried_single_changes = false;  ///< all of them
  bool is_complete = false;           ///< no neighbour of the fronts is left to try
  std::vector<TradeKnob> knobs;
  std::vector<TradeRow> rows;  ///< the default first
  std::vector<TradeAnswer> answers;
};

/// Measures the default and the presets, then settings that differ from the default in one knob,
/// then neighbours of the fronts while the time lasts (Pareto local search), and at last the times
/// near the front again, in turns. The plan has one model, a scan or a mesh.
Result<TradeReport> measure_trade(const ScenePlan& plan, const TradeJob& job, GlPlatform platform,
                                  Progress& progress);

}  // namespace relief::cli
