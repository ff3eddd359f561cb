#include "renderer/engines/volume_truth/truth_settings.h"

#include <cmath>
#include <string>

#include "renderer/engine_options.h"

namespace relief::volume_truth {
namespace {

constexpr NumberChoice kSteps{0.01, 1.0};
constexpr NumberChoice kSamples{1.0, 64.0};

template <class T>
T value_of(const RenderSettings& settings, const std::string& key, T fallback) {
  const auto found = settings.options.find(key);
  return found == settings.options.end() ? fallback : std::get<T>(found->second);
}

template <class T, std::size_t N>
EngineOption own_choice(OptionRow row, const std::array<Named<T>, N>& names) {
  row.kind = OptionKind::Choice;
  for (const Named<T>& named : names) row.choices.emplace_back(named.name);
  return own_option(std::move(row), std::string(names.front().name));
}

}  // namespace

std::vector<EngineOption> truth_options() {
  std::vector<EngineOption> options;
  options.push_back(own_choice({.key = "truth",
                                .help = "what is exact about a volume: its kernels' sum, or its "
                                        "interpolated values, classified along rays",
                                .default_text = "kernels"},
                               kTruths));
  options.push_back(own_option(
      {.key = "step",
       .kind = OptionKind::Number,
       .range = kSteps,
       .placeholder = "S",
       .help = "longest step along rays: standard deviations of kernels, or spacings of a field",
       .default_text = "0.4"},
      TruthSettings{}.step));
  options.push_back(own_choice(
      {.key = "order",
       .help = "3D Gaussians are ordered by where rays meet them, or by their centres' depths",
       .default_text = "ray"},
      kGaussianOrders));
  options.push_back(
      own_option({.key = "samples",
                  .kind = OptionKind::Integer,
                  .range = kSamples,
                  .placeholder = "N",
                  .help = "samples a pixel, in a square grid of at least N; 1 is not antialiased",
                  .default_text = "1"},
                 1.0));
  return options;
}

TruthSettings truth_settings(const RenderSettings& settings) {
  TruthSettings chosen;
  chosen.truth = *find_named(kTruths, value_of(settings, "truth", std::string("kernels")));
  chosen.order = *find_named(kGaussianOrders, value_of(settings, "order", std::string("ray")));
  chosen.step = value_of(settings, "step", chosen.step);
  chosen.side = static_cast<int>(std::ceil(std::sqrt(value_of(settings, "samples", 1.0))));
  return chosen;
}

}  // namespace relief::volume_truth
