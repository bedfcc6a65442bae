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

std::string certificate_of(const window::Sight& sight, bool timed) {
  const Certificate& c = sight.certificate;
  const std::string error = std::isfinite(c.error_estimate_mm)
                                ? fmt::format("error {:.1e} mm", c.error_estimate_mm)
                                : "error not known";
  const std::string took = timed ? fmt::format("   {:.0f} ms", 1000 * sight.seconds) : "";
  return fmt::format("residual {:.1e} N   pivots {}   {}   {} edges{}", c.residual_N,
                     c.negative_pivots, error, meshes_of(sight.meshes), took);
}

std::string standing_of(const window::DesignCourse& course) {
  const double percent = 100 / course.length_scale_mm;
  const window::DesignPoint& now = course.points.back();
  return fmt::format("designing: iteration {}, largest {:.3f} %, mean {:.3f} % (Esc stops)",
                     course.iterations, percent * now.max_mm, percent * now.mean_mm);
}

/// How far the movie is that is made beside the window.
void movie_standing(const Panel& panel) {
  const std::string said = panel.desk.movie_work.standing();
  const std::string line = "movie " + (said.empty() ? "0 %" : said);
  const char* stop = window::find_action("stop_movie")->label;
  const float width = ImGui::CalcTextSize(line.c_str()).x + ImGui::CalcTextSize(stop).x +
                      3 * ImGui::GetStyle().FramePadding.x + panel.px(18);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
  ImGui::TextUnformatted(line.c_str());
  ImGui::SameLine(0, panel.px(10));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {panel.px(6), 0});
  panel.button("stop_movie");
  ImGui::PopStyleVar();
}

}  // namespace

void status_line(const Panel& panel, const render::Box& box) {
  const window::Desk& desk = panel.desk;
  const window::Sight& sight = *desk.sight;
  const bool dark = desk.show.dark;
  begin_fixed("status", box, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  if (sight.any()) {
    const ImU32 ink = !sight.stable()          ? bad_ink(dark)
                      : sight.weakness.empty() ? good_ink(dark)
                                               : doubt_ink(dark);
    const std::string lacks = sight.weakness.empty() ? "" : ", " + sight.weakness;
    ImGui::PushStyleColor(ImGuiCol_Text, ink);
    ImGui::TextUnformatted(((sight.stable() ? "● stable" : "● not stable") + lacks).c_str());
    ImGui::PopStyleColor();
    panel.named("stability", "whether the Hessian is positive definite with what is held held");
    if (!sight.symmetry.empty()) {
      ImGui::SameLine(0, panel.px(14));
      ImGui::TextUnformatted(sight.symmetry.c_str());
      panel.named("symmetry", "symmetries of the square that leave this shape as it is");
    }
    ImGui::SameLine(0, panel.px(14));
    ImGui::TextUnformatted(certificate_of(sight, desk.timed).c_str());
    panel.named("certificate",
                "largest force that nothing holds; negative pivots of the Hessian; estimated error "
                "of the joints; meshes, edges a segment; time of the last equilibrium");
    ImGui::SameLine(0, panel.px(18));
  }
  const double busy = desk.engine.busy_seconds();
  std::string said =
      busy > 0.3 ? fmt::format("solving for {:.1f} s (Esc stops)", busy) : desk.message;
  if (sight.designing()) said = standing_of(*sight.design);
  const bool bad = busy <= 0.3 && desk.message_bad && !sight.designing();
  ImGui::PushStyleColor(ImGuiCol_Text,
                        bad ? bad_ink(dark) : ImGui::GetColorU32(ImGuiCol_TextDisabled));
  // one line, however much was said: the tooltip has all of it
  const std::string line = said.substr(0, said.find('\n'));
  ImGui::TextUnformatted(line.c_str());
  ImGui::PopStyleColor();
  panel.named("message", said);
  if (desk.movie_work.under_way()) movie_standing(panel);
  ImGui::End();
}

}  // namespace gridshell::ui
