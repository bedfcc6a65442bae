#include "app/net_pictures.h"

#include <fmt/format.h>

#include "app/pictures.h"
#include "render/figure/block_figure.h"
#include "render/figure/net_figure.h"
#include "render/figure/net_plots.h"
#include "render/image/png.h"

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
Result<void> draw_block_pictures(const CaseRecord& one, const render::MovieStyle& style,
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

Result<void> draw_net_pictures(const std::vector<CaseRecord>& records, render::Renderer& renderer,
                               const fs::path& stem, Watch& watch) {
  const auto style = style_of(records.front().preset, Pictures::stills);
  std::vector<render::NetRun> shells, shades;
  std::vector<render::NamedRun> named;
  for (const CaseRecord& one : records) {
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

}  // namespace gridshell::app
