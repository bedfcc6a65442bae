// Forms a circular shell of 12 x 12 rods at three quarters of its radius, and writes its frames
// into a folder.
#include <cstdio>

#include "engine/gridshell.h"

int main(int count, char** arguments) {
  using namespace gridshell;
  preset::Preset preset;
  preset.title = "A first gridshell";
  preset.footprint.rods = 12;
  preset.footprint.radius_mm = 126;
  preset.actuation.radius_mm = 94.5;
  preset.movie.frames = 5;
  Watch watch;
  record::FolderSink sink(count > 1 ? arguments[1] : "first", {"first", record::Kind::run});
  const auto summary = simulate::run(preset, false, sink, watch);
  if (!summary) {
    std::fprintf(stderr, "%s\n", summary.error().message.c_str());
    return 1;
  }
  const auto run = sink.finish(*summary);
  if (!run) {
    std::fprintf(stderr, "%s\n", run.error().message.c_str());
    return 1;
  }
  std::printf("%zu frames, %.3f mJ of bending, %.2f mm high, %s\n", run->frames.size(),
              summary->energies[Term::bend], summary->height_mm,
              summary->stable ? "stable" : "not stable");
}
