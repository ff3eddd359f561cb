#include "cli/trade/trade_command.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "cli/console.h"
#include "cli/options/paths.h"
#include "cli/options/values.h"
#include "cli/reports/trade_report.h"
#include "cli/trade/trade.h"
#include "cli/trade/trade_page.h"
#include "common/io/extension.h"
#include "common/io/file.h"
#include "loader/models/load_volume.h"
#include "preprocess/raster/raster.h"

namespace relief::cli {
namespace {

/// Of each setting, and of those near the front, at the end.
constexpr TradeRounds kRounds{5, 1.0};
constexpr TradeRounds kFinalRounds{20, 2.5};

/// Fails unless the scene is a scan or a mesh, whose conversion can be varied.
Status check_scan(const ScenePlan& plan, const RenderArguments& image) {
  const std::filesystem::path& input = image.input;
  const char* found = nullptr;
  if (!plan.file.empty()) found = "a scene";
  if (lower_extension(input) == ".relief") found = "a patch file";
  if (has_kernels(plan.models, image.volume)) found = "a volume or 3D Gaussians";
  if (found == nullptr && is_raster(input, {})) found = "a raster";
  if (found == nullptr) return {};
  return make_error("{}: is {}; --trade converts with many settings, so it needs a scan or a mesh",
                    input.string(), found);
}

void add_question(const std::string& text, TradeArguments& arguments) {
  auto question = parse_question(text);
  if (!question) throw CLI::ValidationError("--ask", question.error().message);
  arguments.questions.push_back(std::move(*question));
}

TradeJob job_of(const RenderArguments& image, const TradeArguments& arguments) {
  TradeJob job;
  job.truth = arguments.truth;
  job.seconds = arguments.seconds;
  job.final_rounds = {image.frames.value_or(kFinalRounds.frames), kFinalRounds.seconds};
  job.rounds = {std::min(kRounds.frames, job.final_rounds.frames), kRounds.seconds};
  job.questions = arguments.questions;
  if (!job.questions.empty()) return job;
  for (const std::string& text : usual_questions()) job.questions.push_back(*parse_question(text));
  return job;
}

}  // namespace

void add_trade_options(CLI::App& sub, TradeArguments& arguments) {
  CLI::Option* const trade =
      sub.add_flag("--trade", arguments.is_wanted,
                   "Measure what speed, size and accuracy cost each other, with many settings of "
                   "`relief convert` and `relief render`; writes a page with plots and answers")
          ->excludes("--plot")
          ->excludes("--engines")
          ->excludes("--sweep");
  sub.add_option("--trade-seconds", arguments.seconds,
                 "Time for --trade, in seconds, 1 to 1000000, about; the default setting and the "
                 "presets are measured in any case (default 300)")
      ->check(number_from(1.0, 1e6))
      ->needs(trade)
      ->option_text("S");
  sub.add_option("--truth", arguments.truth,
                 "Mesh that --trade compares with (default: the faces of the input, or else its "
                 "patches with 4 samples a point)")
      ->needs(trade)
      ->option_text("FILE");
  sub.add_option_function<std::vector<std::string>>(
         "--ask",
         [&arguments](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) add_question(text, arguments);
         },
         "Question that --trade answers, once or more: fastest, best, smallest or quickest (to "
         "convert), then limits: at N dB, of the picture, or of the surface for smallest and "
         "quickest; under N ms, s, kB or MB (default: fastest at 35 dB, best under 30 ms, smallest "
         "at 80 dB)")
      ->needs(trade)
      ->expected(1)
      ->take_all()
      ->option_text("TEXT");
  sub.add_option("--report", arguments.page,
                 "Page that --trade writes, which needs no other file (default trade.html)")
      ->check([](const std::string& name) {
        return lower_extension(name) == ".html"
                   ? std::string()
                   : "expected a name that ends in .html; found " + name;
      })
      ->needs(trade)
      ->option_text("OUT.html");
}

int run_trade(const ScenePlan& plan, const RenderArguments& image, const TradeArguments& arguments,
              const std::vector<std::filesystem::path>& inputs) {
  if (const Status scan = check_scan(plan, image); !scan) return fail(scan.error());
  if (const Status writable = check_output(arguments.page, inputs); !writable)
    return fail(writable.error());
  const InterruptedFiles unfinished({arguments.page}, nullptr);
  ConsoleProgress progress;
  const auto report = measure_trade(plan, job_of(image, arguments), image.platform, progress);
  progress.finish();
  if (!report) return fail(report.error());
  const std::string page = trade_page(*report);
  const Status written =
      write_file_atomically(arguments.page, std::as_bytes(std::span<const char>(page)));
  if (!written) return fail(written.error());
  InterruptedFiles::note_complete();
  return image.json ? print_json(as_json(*report))
                    : print_result(as_text(*report, arguments.page.string()));
}

}  // namespace relief::cli
