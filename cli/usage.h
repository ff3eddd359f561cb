// Wrong usage in one line that names the wrong word and the nearest right one.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace relief::cli {

/// Returns the word of `among` that `word` is most likely meant to be: the one that the fewest
/// letters added, left out, replaced or swapped make of it, at most one in three. Empty if none is
/// that near.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       const std::vector<std::string>& among);

/// Returns the command line with `help`, `help SUBCOMMAND` and `version` turned into the options
/// that they stand for. `words`: without the program's name.
[[nodiscard]] std::vector<std::string> with_help_words(std::vector<std::string> words);

/// Prints what is wrong with the command line, in one line on standard error, and returns
/// kWrongUsage. A word that nobody knows comes first: what is missing may be missing because of it.
int report_wrong_usage(const CLI::App& app, const CLI::ParseError& error);

}  // namespace relief::cli
