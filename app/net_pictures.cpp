#include "app/net_pictures.h"

#include <fmt/format.h>

#include "app/pictures.h"
#include "render/figure/net_figure.h"
#include "render/figure/net_plots.h"
#include "render/image/png.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

std::string name_of(const preset::Net& net) {
  switch (net.kind) {
    case preset::NetKind::sphere:
      return net.cut_height == 0 ? "hemisphere"
                                 : fmt::format("*z*^{{*}}/*ρ* = {:g}", net.cut_height);
    case preset::NetKind::cylinder:
      return "cylinder";
    default:
      return "saddle";
  }
}

fs::path with_suffix(fs::path stem, const char* suffix) { return stem += suffix; }

}  // namespace

Result<void> draw_net_pictures(const std::vector<NetRecord>& records, render::Renderer& renderer,
                               const fs::path& stem, Watch& watch) {
  const auto style = style_of(records.front().preset, Pictures::stills);
  std::vector<render::NetRun> shells, shades;
  std::vector<render::NamedRun> named;
  for (const NetRecord& one : records) {
    const std::string name = name_of(one.preset.net);
    const double largest =
        render::deviation_of_nodes(one.run).head(long(one.run.layout.joints.size())).maxCoeff();
    shells.push_back({&one.run, name});
    shades.push_back({&one.run, fmt::format("{}: at most {:.2f} %", name, 100 * largest)});
    named.push_back({&one.run, name});
  }
  const auto save = [&](const char* suffix) {
    return [&, suffix](const render::Image& image) {
      return render::write_png(image, with_suffix(stem, suffix));
    };
  };
  return render::draw_over_nets(shells, style, renderer, watch)
      .and_then(save("_net.png"))
      .and_then([&] { return render::draw_deviations(shades, style, renderer, watch); })
      .and_then(save("_deviation.png"))
      .and_then([&] { return render::write_footprints(with_suffix(stem, "_footprint"), named); })
      .and_then([&] {
        return render::write_plot(with_suffix(stem, "_K"), render::curvature_plot(named));
      })
      .and_then([&]() -> Result<void> {
        if (records.size() > 1 || !render::on_sphere(records.front().run.layout)) return {};
        return render::write_plot(with_suffix(stem, "_latitude"),
                                  render::latitude_plot(named.front()));
      });
}

}  // namespace gridshell::app
