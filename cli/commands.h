// The subcommands of `relief`, one file each. Each function declares the options of a subcommand.
// Once they are parsed, `command` is what the user chose.
#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace relief::cli {

/// Runs what the command line asked for. Returns the exit code: 0 done, 1 failed, 2 wrong usage
/// that shows only once all options are known.
using Command = std::function<int()>;

/// relief bench: times every method to draw a scene and compares it with the truth.
void add_bench(CLI::App& app, Command& command);

/// relief compare: measures how far an image is from a reference.
void add_compare(CLI::App& app, Command& command);

/// relief convert: converts a scan to a patch file.
void add_convert(CLI::App& app, Command& command);

/// relief export: writes patches as points or as a mesh, for other programs.
void add_export(CLI::App& app, Command& command);

/// relief info: prints what a patch file holds, and checks every byte of it.
void add_info(CLI::App& app, Command& command);

/// relief render: renders a patch file, a scan or a scene.
void add_render(CLI::App& app, Command& command);

}  // namespace relief::cli
