// `gridshell compare A B`: the image-regression metric, on pictures or folders of them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/baselines.h"
#include "app/commands/commands.h"
#include "app/console.h"
#include "render/image/compare.h"
#include "render/image/png.h"

namespace gridshell::app {
namespace {

struct CompareOptions {
  std::string a, b, difference, why;
  bool update = false;
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

Result<bool> compare_folders(const CompareOptions& options) {
  const auto pairs = as_input(pictures_of(options.a, options.b));
  if (!pairs) return tl::unexpected(pairs.error());
  std::vector<render::PicturePair> different;
  for (const render::PicturePair& pair : *pairs) {
    const auto verdict = render::judge(pair, options.threshold);
    if (verdict.same) continue;
    fmt::print("{}: {}\n", pair.name, verdict.text);
    different.push_back(pair);
  }
  fmt::print("{} of {} pictures differ, threshold {}\n", different.size(), pairs->size(),
             options.threshold);
  if (!options.difference.empty() && !different.empty()) {
    const auto written =
        render::write_png(render::contact_sheet(different, options.threshold), options.difference);
    if (!written) return tl::unexpected(written.error());
  }
  if (!options.update) return different.empty();
  return update_baselines(options.a, *pairs, options.threshold, options.why).map([] {
    return true;
  });
}

Result<bool> compare_any(const CompareOptions& options) {
  const bool a = std::filesystem::is_directory(options.a),
             b = std::filesystem::is_directory(options.b);
  if (a != b)
    return fail(
        Fault::bad_input,
        fmt::format("'{}' is a folder and '{}' is none: compare two pictures or two folders",
                    a ? options.a : options.b, a ? options.b : options.a));
  if (options.update && (!a || options.why.empty()))
    return fail(Fault::bad_input, a ? "--update needs --why \"...\": the reason is kept beside the "
                                      "pictures"
                                    : "--update is of folders of kept pictures");
  return a ? compare_folders(options) : compare_pictures(options);
}

}  // namespace

void add_compare(CLI::App& program, Action& action) {
  const auto options = std::make_shared<CompareOptions>();
  auto* command = program.add_subcommand(
      "compare", "whether two pictures, or folders of them, are the same to the eye");
  command->add_option("A", options->a, "a PNG, or a folder of kept ones")->required();
  command->add_option("B", options->b, "another of the same size, or a folder")->required();
  command
      ->add_option("--threshold", options->threshold,
                   "largest mean difference of an 8 x 8 block, of 255")
      ->check(CLI::Range(0.0, 255.0))
      ->capture_default_str();
  command->add_option("--difference", options->difference,
                      "PNG to write, differences in red; of folders a sheet of all that differ");
  command->add_flag("--update", options->update, "put B's pictures in the place of A's");
  command->add_option("--why", options->why, "with --update: the reason, kept in A/WHY.md");
  command->callback([&action, options] {
    action = [options]() -> int {
      const auto same = compare_any(*options);
      if (!same) return report(same.error());
      return *same ? ExitCode::done : ExitCode::different;
    };
  });
}

}  // namespace gridshell::app
