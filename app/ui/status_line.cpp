// The certificate of the state in sight, what the engine is at, what was said last.
#include <fmt/format.h>

#include <cmath>

#include "app/ui/look.h"
#include "app/ui/panel.h"

namespace gridshell::ui {
namespace {

std::string meshes_of(const std::vector<int>& meshes) {
  std::string text;
  for (int edges : meshes) text += (text.empty() ? "" : "·") + std::to_string(edges);
  return text;
}

std::string certificate_of(const window::Sight& sight) {
  const Certificate& c = sight.certificate;
  const std::string error = std::isfinite(c.error_estimate_mm)
                                ? fmt::format("error {:.1e} mm", c.error_estimate_mm)
                                : "error not known";
  return fmt::format("residual {:.1e} N   pivots {}   {}   {} edges   {:.0f} ms", c.residual_N,
                     c.negative_pivots, error, meshes_of(sight.meshes), 1000 * sight.seconds);
}

}  // namespace

void status_line(const Panel& panel, const render::Box& box) {
  const window::Desk& desk = panel.desk;
  const window::Sight& sight = *desk.sight;
  const bool dark = desk.show.dark;
  begin_fixed("status", box, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  if (sight.any()) {
    const ImU32 ink = sight.stable() ? good_ink(dark) : bad_ink(dark);
    ImGui::PushStyleColor(ImGuiCol_Text, ink);
    ImGui::TextUnformatted(sight.stable() ? "● stable" : "● not stable");
    ImGui::PopStyleColor();
    panel.named("stability", "whether the Hessian is positive definite with what is held held");
    ImGui::SameLine(0, panel.px(14));
    ImGui::TextUnformatted(certificate_of(sight).c_str());
    panel.named("certificate",
                "largest force that nothing holds; negative pivots of the Hessian; estimated error "
                "of the joints; meshes, edges a segment; time of the last equilibrium");
    ImGui::SameLine(0, panel.px(18));
  }
  const double busy = desk.engine.busy_seconds();
  const std::string said =
      busy > 0.3 ? fmt::format("solving for {:.1f} s (Esc stops)", busy) : desk.message;
  const bool bad = busy <= 0.3 && desk.message_bad;
  ImGui::PushStyleColor(ImGuiCol_Text,
                        bad ? bad_ink(dark) : ImGui::GetColorU32(ImGuiCol_TextDisabled));
  // one line, however much was said: the tooltip has all of it
  const std::string line = said.substr(0, said.find('\n'));
  ImGui::TextUnformatted(line.c_str());
  ImGui::PopStyleColor();
  panel.named("message", said);
  ImGui::End();
}

}  // namespace gridshell::ui
