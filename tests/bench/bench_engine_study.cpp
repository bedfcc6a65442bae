#include <fmt/format.h>
#include <cstdlib>
#include "engine/preset/reader.h"
#include "engine/core/atomic_file.h"
#include "engine/study/accuracy_study.h"
using namespace gridshell;
int main(int argc, char** argv) {
  Watch watch;
  auto presets = preset::read_preset_file(argv[1]);
  (void)argc;
  auto p = presets->cases.empty() ? presets->base : presets->cases[0].preset;
  auto s = study::accuracy_study(p, {}, watch);
  if (!s) { fmt::print("{}\n", s.error().message); return 1; }
  fmt::print("reference {:.1e}\n{}\n{}", s->reference_error, record::accuracy_csv(s->rows), record::scaling_csv(s->scaling));
  for (auto& a : s->standings) fmt::print("auto {:.0e}: error {:.1e} {:.2e} s, front {:.2f} asked {:.2f}\n", a.tolerance, a.error, a.cpu_s, a.cpu_s/a.front_s, a.cpu_s/a.asked_s);
}
