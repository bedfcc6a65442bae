// Forms a shell, pushes a joint in three steps and releases it; prints the force and the
// certificate of each step.
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
  Report report = session->move_to(1, unwatched);
  const int joint = 14;
  for (int step = 1; step <= 3 && report.end == Outcome::reached; ++step) {
    report = session->push(joint, {0, 0, -1}, Across::free, unwatched);
    std::printf("%d mm: %.4f N, residual %.1e N, %s\n", step, -session->force(0).z(),
                report.certificate.residual_N,
                report.certificate.stable() ? "stable" : "not stable");
  }
  report = session->release(joint, unwatched);
  std::printf("released: %.3f mJ of bending\n", session->energies()[Term::bend]);
  return report.end == Outcome::reached ? 0 : 1;
}
