#include "app/cli/figures.h"

#include <fmt/format.h>
#include <cstdio>

#include "app/cli/console.h"
#include "app/cli/paper_page.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "engine/gridshell.h"
#include "render/gl/image.h"
#include "render/movie/encode.h"
#include "render/movie/movie_writer.h"
#include "render/movie/run_figures.h"
#include "render/movie/run_plots.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

std::string name_of(const preset::Preset& preset) {
  if (preset.footprint.kind == preset::FootprintKind::blocks) return "assemblage";
  const preset::Net& net = preset.net;
  switch (net.kind) {
    case preset::NetKind::sphere:
      return net.cut_height == 0 ? "hemisphere"
                                 : fmt::format("*z*^{{*}}/*ρ* = {:g}", net.cut_height);
    case preset::NetKind::cylinder:
      return "cylinder";
    case preset::NetKind::profile:
      return "surface of revolution";
    case preset::NetKind::translation:
      return "translation net";
    case preset::NetKind::surface:
      return "surface";
    case preset::NetKind::spool:
    case preset::NetKind::beltrami:
      break;
  }
  return "saddle";
}

fs::path with_suffix(fs::path stem, const char* suffix) { return stem += suffix; }

/// Of one assemblage: its blocks apart, their footprints, and how they meet.
Result<void> draw_block_pictures(const CaseRun& one, const render::MovieStyle& style,
                                 render::Renderer& renderer, const fs::path& stem, Watch& watch) {
  return render::draw_blocks(one.run, style, renderer, watch)
      .and_then(render::draw_panels)
      .and_then([&](const render::Image& image) {
        return render::write_png(image, with_suffix(stem, "_blocks.png"));
      })
      .and_then([&] {
        return render::write_block_footprints(with_suffix(stem, "_footprint"), one.run, style.title,
                                              style.print);
      })
      .and_then([&]() -> Result<void> {
        if (one.run.layout.seam_rods.empty()) return {};
        render::Plot seams = render::seam_plot(one.run);
        seams.title = render::plain(style.title);
        return render::write_plot(with_suffix(stem, "_seams"), seams, style.print);
      });
}

/// "hemisphere: at most 3.10 %", of the joints; where there is room for it, of one shell alone,
/// with the rods where they lie further off between them, which the colours show too.
std::string caption_of(const record::Trajectory& run, const std::string& name, bool alone) {
  constexpr double further = 1.2;
  const Eigen::VectorXd deviation = render::last_deviation(run);
  const render::DeviationUnit unit = render::deviation_unit(run.layout);
  const double joints = unit.factor * deviation.head(long(run.layout.joints.size())).maxCoeff(),
               rods = unit.factor * deviation.maxCoeff();
  const char* word = run.layout.parts.empty() ? "%" : "mm";
  if (!alone || rods <= further * joints)
    return fmt::format("{}: at most {:.2f} {}", name, joints, word);
  return fmt::format("{}: joints at most {:.2f}, rods {:.2f} {}", name, joints, rods, word);
}

}  // namespace

Result<void> draw_net_pictures(const std::vector<CaseRun>& records, render::Renderer& renderer,
                               const fs::path& stem, Watch& watch) {
  const auto style = style_of(records.front().preset, Pictures::stills);
  std::vector<render::NetRun> shells, shades;
  std::vector<render::NamedRun> named;
  for (const CaseRun& one : records) {
    const std::string name = one.name.empty() ? name_of(one.preset) : one.name;
    shells.push_back({&one.run, name, scan_of(one.preset)});
    shades.push_back({&one.run, caption_of(one.run, name, records.size() == 1)});
    named.push_back({&one.run, name});
  }
  const auto titled = [&](render::Plot plot) {
    plot.title = render::plain(style.title);
    return plot;
  };
  const double dpi = style.print.width_mm > 0 ? style.print.dpi : 0;
  const auto save = [&, dpi](const char* suffix) {
    return [&, suffix, dpi](const render::Image& image) {
      return render::write_png(image, with_suffix(stem, suffix), dpi);
    };
  };
  return render::draw_over_nets(shells, style, renderer, watch)
      .and_then(render::draw_panels)
      .and_then(save("_net.png"))
      .and_then([&] { return render::draw_deviations(shades, style, renderer, watch); })
      .and_then(render::draw_panels)
      .and_then(save("_deviation.png"))
      .and_then([&] {
        const bool blocks = records.size() == 1 && !records.front().run.layout.parts.empty();
        return blocks ? draw_block_pictures(records.front(), style, renderer, stem, watch)
                      : render::write_footprints(with_suffix(stem, "_footprint"), named,
                                                 style.title, style.print);
      })
      .and_then([&] {
        return render::write_plot(with_suffix(stem, "_K"), titled(render::curvature_plot(named)),
                                  style.print);
      })
      .and_then([&] {
        return render::write_plot(with_suffix(stem, "_quantiles"),
                                  titled(render::quantile_plot(named)), style.print);
      })
      .and_then([&]() -> Result<void> {
        if (records.size() > 1 || !render::on_sphere(records.front().run.layout)) return {};
        return render::write_plot(
            with_suffix(stem, "_latitude"),
            titled(render::latitude_plot(named.front(), shells.front().scanned)), style.print);
      });
}

namespace fs = std::filesystem;

bool drawn_side_by_side(const preset::Preset& preset, const std::string& case_name) {
  return preset.movie.beside && !case_name.empty();
}

Result<void> draw_beside(const std::vector<CaseRun>& records, const std::string& title,
                         render::Renderer& renderer, const fs::path& folder, Watch& watch) {
  auto style = style_of(records.front().preset, Pictures::movie);
  style.title = title;
  std::vector<render::ComparedRun> runs;
  for (const CaseRun& one : records) runs.push_back({&one.run, one.preset.title});
  std::size_t frames = 0;
  for (const CaseRun& one : records) frames = std::max(frames, one.run.frames.size());
  return make_movie(folder, records.front().preset, style, int(frames), watch,
                    [&](const render::FrameCallback& seen) {
                      return render::write_side_by_side(runs, style, renderer, folder / "frames",
                                                        watch, seen);
                    });
}

Result<void> draw_push_pictures(const std::vector<CaseRun>& records, const std::string& title,
                                render::Renderer& renderer, const fs::path& stem, Watch& watch) {
  auto style = style_of(records.front().preset, Pictures::stills);
  // several are the preset's, and each bears its own title
  const bool several = records.size() > 1;
  if (several) style.title = title;
  std::vector<render::NetRun> shells;
  std::vector<render::NamedRun> named;
  for (const CaseRun& one : records) {
    shells.push_back({&one.run, one.preset.title});
    named.push_back({&one.run, one.preset.title});
  }
  render::Plot force = render::force_plot(named);
  force.title = render::plain(style.title);
  // one by itself has its title over its own plot
  const std::string head = several ? title : "";
  const auto with = [&](const char* suffix) { return fs::path(stem) += suffix; };
  return render::draw_pushes(shells, style, renderer, watch)
      .and_then(render::draw_panels)
      .and_then(
          [&](const render::Image& image) { return render::write_png(image, with("_loads.png")); })
      .and_then([&] { return render::write_plot(with("_force"), force, style.print); })
      .and_then([&] { return render::write_push_bins(with("_bins"), named, head, style.print); });
}

bool shown_on_net(const preset::Preset& preset) {
  return preset.on_net() && !preset.indentation.wanted() && !preset.jitter.wanted() &&
         preset.step.empty();
}

Result<void> draw_case_figures(std::vector<CaseRun> records, const std::string& title,
                               render::Renderer& renderer, const fs::path& stem,
                               const std::function<Watch&()>& next_phase) {
  if (records.front().preset.page.kind != preset::PageKind::none)
    return draw_page(records, renderer, stem, next_phase());
  std::vector<CaseRun> nets, pushes;
  for (CaseRun& one : records) {
    if (one.preset.indentation.wanted())
      pushes.push_back(std::move(one));
    else if (shown_on_net(one.preset) && one.run.layout.net_nodes.size() > 0)
      nets.push_back(std::move(one));
  }
  if (!nets.empty())
    if (auto drawn = draw_net_pictures(nets, renderer, stem, next_phase()); !drawn) return drawn;
  if (pushes.empty()) return {};
  return draw_push_pictures(pushes, title, renderer, stem, next_phase());
}

bool stills_show_ends(const preset::Preset& preset) {
  constexpr std::size_t most_steps = 8;
  return preset.indentation.wanted() || preset.step.size() > most_steps;
}

record::Trajectory ends_of(const record::Trajectory& run) {
  record::Trajectory ends;
  ends.layout = run.layout;
  ends.frames = {run.frames.front(), run.frames.back()};
  return ends;
}

namespace fs = std::filesystem;

void draw_refusals(const preset::Presets& presets, const fs::path& folder) {
  for (const auto& run : runs_of(presets)) {
    const auto net = refused_net(run.preset);
    if (!net) continue;
    fs::path stem = folder;
    stem += (run.name.empty() ? "" : "_" + run.name) + "_refused";
    const auto style = style_of(run.preset, Pictures::stills);
    std::error_code unmade;  // told by what writes
    if (stem.has_parent_path()) fs::create_directories(stem.parent_path(), unmade);
    const auto drawn = render::write_plot(
        stem,
        render::refused_plot(net->lines, net->narrow, net->end, render::plain(run.preset.title)),
        style.print, 1.1);
    if (drawn)
      std::fprintf(stderr, "where the net ends: %s.png\n", stem.string().c_str());
    else
      report(drawn.error());
  }
}

}  // namespace gridshell::app
