// The subcommands of `relief`, one file each. Each function declares the options of a subcommand.
// Parsing sets `command` to the subcommand that the user chose.
#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace relief::cli {

/// Runs the chosen subcommand. Returns the exit code: 0 done, 1 failed, 2 wrong usage that only all
/// options together show.
using Command = std::function<int()>;

/// relief bench: times every method to draw a scene and compares it with the truth.
void add_bench(CLI::App& app, Command& command);

/// relief compare: measures how far an image is from a reference.
void add_compare(CLI::App& app, Command& command);

/// relief convert: converts a scan to a patch file.
void add_convert(CLI::App& app, Command& command);

/// relief export: writes patches as points or as a mesh, for other programs.
void add_export(CLI::App& app, Command& command);

/// relief info: prints the contents of a patch file and checks every byte of it.
void add_info(CLI::App& app, Command& command);

/// relief render: renders a patch file, a scan or a scene.
void add_render(CLI::App& app, Command& command);

/// relief view: shows patch files and scans in a window.
void add_view(CLI::App& app, Command& command);

}  // namespace relief::cli
