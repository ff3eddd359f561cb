// Questions to the measurements of `relief bench --trade`, and their answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/trade/trade_row.h"
#include "common/error.h"

namespace relief::cli {

struct TradeQuantity;

/// What is to be the least or the most.
enum class TradeGoal : std::uint8_t {
  Fastest,   ///< least time of a frame
  Best,      ///< highest PSNR of the picture
  Smallest,  ///< fewest bytes on disk
  Quickest   ///< least time of a conversion
};

/// A row must have at least, or at most, so much of something.
struct TradeLimit {
  const TradeQuantity* quantity = nullptr;
  bool is_least = false;
  double value = 0.0;
};

struct TradeQuestion {
  std::string text;
  TradeGoal goal = TradeGoal::Best;
  std::vector<TradeLimit> limits;
};

/// Parses "fastest at 35 dB", "best under 30 ms", "smallest at 80 dB", "quickest at 80 dB under
/// 2 MB": a goal, then limits in dB (of the picture; of the surface where the goal is smallest or
/// quickest), ms (of a frame), s (of a conversion), kB and MB (of the file). Fails with a clause
/// that says what was expected and found.
Result<TradeQuestion> parse_question(const std::string& text);

/// The questions that a report answers if none is asked.
[[nodiscard]] std::vector<std::string> usual_questions();

/// The row that reaches the goal among those within all limits; of equal ones the first. None if no
/// row is within them.
[[nodiscard]] std::optional<std::size_t> answer(const TradeQuestion& question,
                                                const std::vector<TradeRow>& rows);

/// Of a question that no row answers: which limit is out of reach, and the nearest value ("PSNR of
/// the picture, dB: the most is 33.2, not 35").
[[nodiscard]] std::string why_not(const TradeQuestion& question, const std::vector<TradeRow>& rows);

}  // namespace relief::cli
