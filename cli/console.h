// The command's output: results on standard output, everything else on standard error.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "cli/console_progress.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "common/error.h"

namespace relief::cli {

/// Opens those of the three standard streams that are closed, such that reading and writing them
/// fails. Otherwise the next file that is opened would take their place, and get what is printed.
void hold_closed_streams();

/// Prints `error` in one line on standard error and returns kFailed. After an interrupt it prints
/// "interrupted" instead, because that made the job fail. `kept`: the files written before, if any
/// ("2 of 12 images were written").
int fail(const Error& error, std::string_view kept = {});

/// Prints a result on standard output and returns the exit code: kFailed, with a sentence, if
/// standard output cannot be written (full disk, closed). A pipe whose reader has left is no
/// failure: `relief info x.relief | head -1` has read what it wanted.
int print_result(std::string_view text);
int print_json(const nlohmann::ordered_json& result);

/// Prepares standard input if "-" is among the inputs (common/io/standard_input.h).
Status open_inputs(const std::vector<std::filesystem::path>& inputs);

}  // namespace relief::cli
