#include "cli/trade/trade_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "cli/options/values.h"
#include "cli/trade/trade_front.h"
#include "common/scene/choices.h"

namespace relief::cli {
namespace {

constexpr std::array<Named<TradeGoal>, 4> kGoals{{{"fastest", TradeGoal::Fastest},
                                                  {"best", TradeGoal::Best},
                                                  {"smallest", TradeGoal::Smallest},
                                                  {"quickest", TradeGoal::Quickest}}};

constexpr const char* kExpected =
    "expected a goal and limits, as in \"fastest at 35 dB\", \"best under 30 ms\", \"smallest at "
    "80 "
    "dB\" or \"quickest at 80 dB under 2 MB\"";

/// Whether decibels are those of the surface: a file has no picture.
bool asks_for_surface(TradeGoal goal) {
  return goal == TradeGoal::Smallest || goal == TradeGoal::Quickest;
}

std::optional<TradeLimit> limit_of(TradeGoal goal, std::string_view word, double number,
                                   std::string_view unit) {
  if (word == "at" && unit == "dB")
    return TradeLimit{asks_for_surface(goal) ? &surface_psnr() : &picture_psnr(), true, number};
  if (word != "under") return std::nullopt;
  if (unit == "ms") return TradeLimit{&frame_time(), false, number};
  if (unit == "s") return TradeLimit{&conversion_time(), false, number};
  if (unit == "kB") return TradeLimit{&file_size(), false, 1e3 * number};
  if (unit == "MB") return TradeLimit{&file_size(), false, 1e6 * number};
  return std::nullopt;
}

bool is_within(const TradeLimit& limit, const TradeRow& row) {
  const auto value = limit.quantity->of(row);
  return value && (limit.is_least ? *value >= limit.value : *value <= limit.value);
}

/// Less is better.
std::optional<double> price_of(TradeGoal goal, const TradeRow& row) {
  switch (goal) {
    case TradeGoal::Fastest:
      return frame_time().of(row);
    case TradeGoal::Smallest:
      return file_size().of(row);
    case TradeGoal::Quickest:
      return conversion_time().of(row);
    case TradeGoal::Best:
      break;
  }
  const auto psnr_db = picture_psnr().of(row);
  return psnr_db ? std::optional<double>(-*psnr_db) : std::nullopt;
}

}  // namespace

Result<TradeQuestion> parse_question(const std::string& text) {
  TradeQuestion question{text, {}, {}};
  const std::vector<std::string_view> words = split(text, ' ');
  const auto* const goal = std::find_if(kGoals.begin(), kGoals.end(), [&words](const auto& known) {
    return known.name == words.front();
  });
  if (goal == kGoals.end() || words.size() % 3 != 1 || words.size() == 1)
    return make_error("{}; found \"{}\"", kExpected, text);
  question.goal = goal->value;
  for (std::size_t k = 1; k < words.size(); k += 3) {
    const std::optional<double> number = parse_number(words[k + 1]);
    const auto limit =
        number ? limit_of(question.goal, words[k], *number, words[k + 2]) : std::nullopt;
    if (!limit) {
      return make_error(
          "{}; a limit is \"at N dB\" or \"under N ms\", s, kB or MB, and \"{} {} {}\" is none",
          kExpected, words[k], words[k + 1], words[k + 2]);
    }
    question.limits.push_back(*limit);
  }
  return question;
}

std::vector<std::string> usual_questions() {
  return {"fastest at 35 dB", "best under 30 ms", "smallest at 80 dB"};
}

std::optional<std::size_t> answer(const TradeQuestion& question,
                                  const std::vector<TradeRow>& rows) {
  std::optional<std::size_t> found;
  std::optional<double> least;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool fits =
        std::all_of(question.limits.begin(), question.limits.end(),
                    [&](const TradeLimit& limit) { return is_within(limit, rows[k]); });
    const auto price = price_of(question.goal, rows[k]);
    if (!fits || !price || (least && *price >= *least)) continue;
    found = k;
    least = price;
  }
  return found;
}

std::string why_not(const TradeQuestion& question, const std::vector<TradeRow>& rows) {
  for (const TradeLimit& limit : question.limits) {
    std::optional<double> nearest;
    for (const TradeRow& row : rows) {
      const auto value = limit.quantity->of(row);
      if (value && (!nearest || (limit.is_least ? *value > *nearest : *value < *nearest)))
        nearest = value;
    }
    const bool is_reached =
        nearest && (limit.is_least ? *nearest >= limit.value : *nearest <= limit.value);
    if (is_reached) continue;
    if (!nearest) return fmt::format("{} was not measured", limit.quantity->label);
    return fmt::format("{}: {} is {:.4g}, not {:.4g}", limit.quantity->label,
                       limit.is_least ? "the most" : "the least", *nearest, limit.value);
  }
  return "no setting is within all limits at once";
}

}  // namespace relief::cli
