// An energy of one's own: a bed of springs under the joints, applied as loads of a simulation.
#include <cstdio>

#include "engine/gridshell.h"

int main() {
  using namespace gridshell;
  preset::Preset preset;
  preset.footprint.rods = 6;
  preset.footprint.radius_mm = 60;
  preset.actuation.radius_mm = 48;
  const auto scene = scene_of(preset);
  if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 1;
  auto session = Simulation::open(std::make_shared<const Scene>(*scene), plan_of_mesh(4));
  if (!session) return std::fprintf(stderr, "%s\n", session.error().message.c_str()), 1;
  const auto begun = session->begin_buckled(0.02, unwatched);
  if (!begun) return std::fprintf(stderr, "%s\n", begun.error().message.c_str()), 1;
  const auto reached = [](const Report& report, const char* what) {
    if (report.end == Outcome::reached) return true;
    std::fprintf(stderr, "%s: %s\n", what, words_of(report.end).what);
    return false;
  };
  if (!reached(session->move_to(1, unwatched), "the shell was not formed")) return 1;
  const auto height = [&] {
    return session->nodes().row(2).leftCols(session->shell().finest().joints).maxCoeff();
  };
  const double before = height();
  // E = k/2 z^2 at every joint; NodeAction computes value, gradient and Hessian
  std::vector<NodeAction> bed;
  for (int joint = 0; joint < session->shell().finest().joints; ++joint)
    bed.push_back({.node = joint, .stiffness = {0, 0, 1e-4}});
  const Report report = session->set_field(bed, unwatched);
  if (!reached(report, "the bed was not applied")) return 1;
  std::printf("on a bed of springs the shell is %.3f mm high instead of %.3f, %s\n", height(),
              before, report.certificate.stable() ? "stable" : "not stable");
}
