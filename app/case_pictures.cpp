#include "app/case_pictures.h"

#include "app/net_pictures.h"
#include "app/page_pictures.h"
#include "app/pictures.h"
#include "render/figure/push_figure.h"
#include "render/image/png.h"
#include "render/movie/beside.h"
#include "render/movie/encode.h"

namespace gridshell::app {
namespace fs = std::filesystem;

bool beside_one_another(const preset::Preset& preset, const std::string& case_name) {
  return preset.movie.beside && !case_name.empty();
}

Result<void> draw_beside(const std::vector<CaseRecord>& records, const std::string& title,
                         render::Renderer& renderer, const fs::path& folder, Watch& watch) {
  auto style = style_of(records.front().preset, Pictures::movie);
  style.title = title;
  std::vector<render::BesideRun> runs;
  for (const CaseRecord& one : records) runs.push_back({&one.run, one.preset.title});
  std::size_t frames = 0;
  for (const CaseRecord& one : records) frames = std::max(frames, one.run.frames.size());
  return make_movie(
      folder, records.front().preset, style, int(frames), watch, [&](const render::OnFrame& seen) {
        return render::write_beside(runs, style, renderer, folder / "frames", watch, seen);
      });
}

Result<void> draw_push_pictures(const std::vector<CaseRecord>& records, const std::string& title,
                                render::Renderer& renderer, const fs::path& stem, Watch& watch) {
  auto style = style_of(records.front().preset, Pictures::stills);
  // several are the preset's, and each bears its own title
  const bool several = records.size() > 1;
  if (several) style.title = title;
  std::vector<render::NetRun> shells;
  std::vector<render::NamedRun> named;
  for (const CaseRecord& one : records) {
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

Result<void> draw_case_figures(std::vector<CaseRecord> records, const std::string& title,
                               render::Renderer& renderer, const fs::path& stem,
                               const std::function<Watch&()>& next_phase) {
  if (records.front().preset.page.kind != preset::PageKind::none)
    return draw_page(records, renderer, stem, next_phase());
  std::vector<CaseRecord> nets, pushes;
  for (CaseRecord& one : records) {
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

}  // namespace gridshell::app
