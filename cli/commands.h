// The subcommands of `relief`, one file each. Each of these functions declares the subcommand's
// options and returns nothing; what the user chose is run after parsing through `Command`.
#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace relief::cli {

/// What the command line asked for: returns the exit code (0 done, 1 could not do it, 2 wrong
/// usage that only shows once all options are known).
using Command = std::function<int()>;

/// relief bench: every way to draw a scene, timed in turns and compared with the truth.
void add_bench(CLI::App& app, Command& command);

/// relief compare: how far one picture is from another.
void add_compare(CLI::App& app, Command& command);

/// relief convert: a scan becomes a patch file.
void add_convert(CLI::App& app, Command& command);

/// relief export: patches as points or as a mesh, for other programs.
void add_export(CLI::App& app, Command& command);

/// relief info: what a patch file holds, and whether every byte of it is right.
void add_info(CLI::App& app, Command& command);

/// relief render: a patch file or a scan becomes a picture.
void add_render(CLI::App& app, Command& command);

}  // namespace relief::cli
