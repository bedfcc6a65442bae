#include "app/refusals.h"

#include <cstdio>

#include "app/console.h"
#include "app/loading.h"
#include "app/pictures.h"
#include "engine/design/refused_net.h"
#include "render/figure/refused_chart.h"

namespace gridshell::app {
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
