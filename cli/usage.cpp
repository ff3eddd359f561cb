#include "cli/usage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "cli/messages.h"

namespace relief::cli {
namespace {

/// Letters to add, leave out, replace or swap with the next, to make `b` of `a`.
std::size_t distance_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = std::exchange(last, std::move(row));
  }
  return last.back();
}

std::vector<std::string> subcommands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& sub) {
  std::vector<std::string> names;
  for (const CLI::Option* option : sub.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// A message without words of more letters than anybody reads: a number of 309 digits.
std::string with_short_words(const std::string& text) {
  constexpr std::size_t longest = 100;
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size() - 1) + 1;
    const std::string word = text.substr(begin, end - begin);
    out += word.size() <= longest ? word : word.substr(0, longest - 4) + "... ";
    begin = end;
  }
  return out;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& among) {
  const std::string nearest = nearest_word(word, among);
  return nearest.empty() ? std::string() : fmt::format("; did you mean {}?", nearest);
}

/// What is wrong with the first word that nobody knows; empty if there is none.
std::string about_unknown_word(const CLI::App& app, const CLI::App* sub) {
  const std::vector<std::string> words = (sub != nullptr ? sub : &app)->remaining();
  if (words.empty()) return {};
  const std::string& word = words.front();
  const std::string_view name = std::string_view(word).substr(0, word.find('='));
  if (sub == nullptr && !name.starts_with('-')) {
    return fmt::format("there is no subcommand {}{}", word, suggestion(name, subcommands_of(app)));
  }
  if (!name.starts_with('-')) return fmt::format("{} is one argument too many", word);
  return fmt::format("there is no option {}{}", name,
                     suggestion(name, options_of(sub != nullptr ? *sub : app)));
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& among) {
  std::string nearest;
  std::size_t least = word.size() / 3 + 1;
  for (const std::string& other : among) {
    const std::size_t distance = distance_between(word, other);
    if (distance >= least) continue;
    least = distance;
    nearest = other;
  }
  return nearest;
}

std::vector<std::string> with_help_words(std::vector<std::string> words) {
  if (words.empty()) return words;
  if (words == std::vector<std::string>{"version"}) return {"--version"};
  if (words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

int report_wrong_usage(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App* const sub = parsed.empty() ? nullptr : parsed.front();
  std::string wrong = about_unknown_word(app, sub);
  if (wrong.empty() && sub == nullptr) {
    wrong = fmt::format("a subcommand is required: {}", fmt::join(subcommands_of(app), ", "));
  }
  if (wrong.empty()) wrong = error.what();
  const std::string name = sub == nullptr ? "" : sub->get_name() + " ";
  print_message(with_short_words(fmt::format("{}{}{}`relief {}--help` lists the options",
                                             sub == nullptr ? "" : sub->get_name() + ": ", wrong,
                                             wrong.ends_with('?') ? " " : "; ", name)));
  return kWrongUsage;
}

}  // namespace relief::cli
