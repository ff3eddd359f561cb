// The `relief` command: parses, then runs the subcommand.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/usage.h"
#include "common/version.h"

namespace {

constexpr const char* kReliefExamples =
    "Examples:\n"
    "  relief convert dragon.ply.gz -o dragon.relief\n"
    "  relief info dragon.relief --verify\n"
    "  relief render dragon.relief -o dragon.png --orbit 30,20\n"
    "  relief render dragon.relief -o dragon.exr --material mirror --env studio.hdr\n"
    "  relief view dragon.relief\n"
    "  relief export dragon.relief -o dragon.glb\n"
    "  relief compare dragon.exr truth.exr --heatmap difference.png\n"
    "  relief bench dragon.ply.gz --plot bench.svg\n"
    "\n"
    "`relief SUBCOMMAND --help` or `relief help SUBCOMMAND` prints all options of a subcommand.\n"
    "Flags are off by default.\n"
    "Exit code: 0 done, 1 failed (one sentence says why), 2 wrong usage.";

int run_relief(int argc, char** argv) {
  CLI::App app(
      "Relief converts point scans to elevation-map patches and renders them in one pass.\n",
      "relief");
  app.set_version_flag("--version", std::string("relief ") + relief::kVersion);
  app.require_subcommand(1);
  app.footer(kReliefExamples);

  relief::cli::Command command;
  relief::cli::add_convert(app, command);
  relief::cli::add_info(app, command);
  relief::cli::add_export(app, command);
  relief::cli::add_render(app, command);
  relief::cli::add_view(app, command);
  relief::cli::add_compare(app, command);
  relief::cli::add_bench(app, command);
  std::vector<std::string> words = relief::cli::with_help_words({argv + 1, argv + argc});
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
  try {
    app.parse(std::move(words));
  } catch (const CLI::Success& help_or_version) {
    if (app.get_subcommands().empty() && app.remaining_size() > 0)  // relief help convrt
      return relief::cli::report_wrong_usage(app, help_or_version);
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    return relief::cli::report_wrong_usage(app, error);
  }
  return command();
}

}  // namespace

int main(int argc, char** argv) {
  relief::cli::hold_closed_streams();
  relief::cli::handle_signals();
  try {
    return run_relief(argc, argv);
  } catch (const std::bad_alloc&) {
    return relief::cli::fail(relief::Error{
        "not enough memory for this model; use a smaller model, or a machine with more"});
  } catch (const std::exception& error) {
    return relief::cli::fail(relief::make_error(
        "internal error: {}; report it with the command and its input", error.what()));
  }
}
