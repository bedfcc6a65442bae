// `gridshell compare A.png B.png`: the image-regression metric.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/console.h"
#include "render/image/compare.h"
#include "render/image/png.h"

namespace gridshell::app {
namespace {

struct CompareOptions {
  std::string a, b, difference;
  double threshold = render::default_difference_threshold;
};

Result<bool> compare_pictures(const CompareOptions& options) {
  const auto a = as_input(render::read_png(options.a));
  if (!a) return tl::unexpected(a.error());
  const auto b = as_input(render::read_png(options.b));
  if (!b) return tl::unexpected(b.error());
  const auto worst = render::compare(*a, *b);
  if (!worst) return tl::unexpected(worst.error());
  const bool same = worst->same(options.threshold);
  fmt::print("{}: worst {} x {} block at ({}, {}) differs by {:.2f} of 255, threshold {}\n",
             same ? "same" : "different", worst->width, worst->height, worst->x, worst->y,
             worst->difference, options.threshold);
  if (!options.difference.empty()) {
    const auto written =
        render::write_png(render::difference_picture(*a, *b, *worst), options.difference);
    if (!written) return tl::unexpected(written.error());
  }
  return same;
}

}  // namespace

void add_compare(CLI::App& program, Action& action) {
  const auto options = std::make_shared<CompareOptions>();
  auto* command = program.add_subcommand("compare", "whether two pictures are the same to the eye");
  command->add_option("A", options->a, "a PNG")->required();
  command->add_option("B", options->b, "another of the same size")->required();
  command
      ->add_option("--threshold", options->threshold,
                   "largest mean difference of an 8 x 8 block, of 255")
      ->check(CLI::Range(0.0, 255.0))
      ->capture_default_str();
  command->add_option("--difference", options->difference, "PNG to write, differences in red");
  command->callback([&action, options] {
    action = [options]() -> int {
      const auto same = compare_pictures(*options);
      if (!same) return report(same.error());
      return *same ? ExitCode::done : ExitCode::different;
    };
  });
}

}  // namespace gridshell::app
