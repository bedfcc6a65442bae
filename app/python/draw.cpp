#include <utility>

#include "app/pictures.h"
#include "app/python/interruptible.h"
#include "app/python/values.h"
#include "render/image/png.h"
#include "render/movie/stage.h"

namespace gridshell::python {
namespace {

Result<void> draw_on(const State& state, const render::MovieStyle& style,
                     const std::filesystem::path& path, const std::string& context) {
  // OpenGL stays on the thread that began it, which is that of this call
  auto artist = app::Artist::create(context, 0, state.preset->style.font);
  if (!artist) return tl::unexpected(artist.error());
  const record::Trajectory run{*state.layout, {state.frame}};
  if (auto showable = render::check_showable(run, style); !showable) return showable;
  const render::Stage stage(run, style);
  auto picture = stage.draw(artist->renderer(), {run.frames.front(), 0});
  if (!picture) return tl::unexpected(picture.error());
  return render::write_png(*picture, path);
}

}  // namespace

void draw(const State& state, const std::filesystem::path& path,
          const std::optional<std::pair<int, int>>& size, const std::string& context) {
  render::MovieStyle style = app::style_of(*state.preset, app::Pictures::movie);
  if (size) std::tie(style.width, style.height) = *size;
  value_of(interruptible([&](const Watch&) { return draw_on(state, style, path, context); }));
}

}  // namespace gridshell::python
