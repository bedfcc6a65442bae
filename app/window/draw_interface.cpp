// A frame of the interface: what of it is drawn anew, how sharp, and on which thread.
#include <algorithm>
#include <chrono>
#include <utility>

#include "app/window/interface.h"
#include "engine/core/try.h"
#include "render/gl/renderer.h"

namespace gridshell::window {
namespace {

// stillness before full resolution; what that may take while an equilibrium is on its way
constexpr double sharp_after_s = 0.15, sharp_while_busy_s = 0.6, longest_while_busy_s = 0.05;
// a moving picture that takes longer has stills that would hold up the pointer
constexpr double longest_moving_s = 0.003;

}  // namespace

/// Anew only where anything that it shows is new, and sharp only once it rests.
Result<void> Interface::draw_shell() {
  if (!viewer_.shell->any() || viewer_.view.width < 16) return {};
  const ShownShell shown{viewer_.camera, viewer_.view, viewer_.show};
  const bool anew = shell_anew_ || shown != shown_;
  if (anew) still_seconds_ = 0;
  const bool idle = viewer_.engine.idle();
  const bool sharp = !anew && still_seconds_ >= (idle ? sharp_after_s : sharp_while_busy_s) &&
                     (idle || picture_.took_s(Resolution::still) < longest_while_busy_s);
  if (!anew && (!sharp || sharp_)) return {};
  if (sharp && take_still(viewer_.picture_request())) return {};
  shown_ = shown;
  shell_anew_ = false;
  sharp_ = sharp;
  ++pictures_;
  return picture_.draw(viewer_.picture_request(), sharp ? Resolution::still : Resolution::moving);
}

/// Whether the still is drawn on another thread; it is shown once it is there.
bool Interface::take_still(const PictureRequest& shown) {
  const auto& draw = viewer_.library.draw_still;
  if (!draw || picture_.took_s(Resolution::moving) < longest_moving_s) return false;
  if (still_.valid()) {
    if (still_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return true;
    const Result<render::Image> image = still_.get();
    if (!image) return false;
    if (still_of_ == pictures_) {
      picture_.show(*image);
      ++pictures_;
      return sharp_ = true;
    }
  }
  still_of_ = pictures_;
  still_ = std::async(std::launch::async, [draw, shown] { return draw(shown); });
  return true;
}

/// Small pictures of the states that were found, each once, from where the camera looks then.
Result<void> Interface::draw_states() {
  const auto& found = viewer_.shell->found;
  if (!found) return states_.clear(), Result<void>();
  std::size_t same = 0, most = std::min(states_.size(), found->size());
  while (same < most && states_[same].first == (*found)[same]) ++same;
  states_.erase(states_.begin() + std::ptrdiff_t(same), states_.end());
  for (std::size_t k = same; k < found->size(); ++k) {
    const auto& state = (*found)[k];
    PictureRequest small{state, viewer_.camera, {160, 100}, viewer_.show, {}};
    small.show.other.reset();
    small.show.mode_mm = 0;
    fit(small.camera, small.view, state->frame.nodes);
    states_.emplace_back(state, ShellPicture(gl_, renderer_));
    ++pictures_;
    TRY_DO(states_.back().second.draw(small, Resolution::still));
  }
  return {};
}

/// Whether a frame made from these lists would look other than the last one.
bool Interface::is_new() {
  std::vector<char> now;
  const auto put = [&now](const auto& list) {
    const char* begin = reinterpret_cast<const char*>(list.Data);
    now.insert(now.end(), begin, begin + list.size_in_bytes());
  };
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    put(list.VtxBuffer), put(list.IdxBuffer);
    put(list.CmdBuffer);
  }
  const char* count = reinterpret_cast<const char*>(&pictures_);
  now.insert(now.end(), count, count + sizeof pictures_);
  const bool same = now == drawn_;
  drawn_ = std::move(now);
  return !same;
}

/// Everything up to the drawing of the lists; whether that would show anything new.
Result<bool> Interface::compose(double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {float(width_), float(height_)};
  io.DeltaTime = float(std::clamp(seconds, 1e-4, 0.5));
  still_seconds_ += seconds;
  shell_anew_ |= viewer_.tick(seconds);
  if (dark_ != viewer_.show.dark) choose_colours(dark_ = viewer_.show.dark, density_);
  feed();
  TRY_DO(draw_states());
  ImGui::NewFrame();
  lay_out();
  ImGui::Render();
  io.MouseWheel = 0;
  if (!viewer_.copied.empty()) ImGui::SetClipboardText(std::exchange(viewer_.copied, "").c_str());
  TRY_DO(draw_shell());
  return is_new();
}

void Interface::paint(bool upwards) {
  const ImVec4& below = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  gl_.ClearColor(below.x, below.y, below.z, 1);
  gl_.Disable(GL_FRAMEBUFFER_SRGB);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  painter_->draw(*ImGui::GetDrawData(), upwards);
}

Result<bool> Interface::frame(double seconds) {
  TRY(anew, compose(seconds));
  if (!*anew) return false;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  paint(true);
  return true;
}

Result<void> Interface::frame_aside(double seconds) {
  TRY(anew, compose(seconds));
  if (!*anew) return {};
  TRY_DO(target_.bind(width_, height_, GL_RGBA8));
  paint(false);
  // as a window waits for what it shows
  gl_.Finish();
  return {};
}

render::Image Interface::read() {
  render::Image image(width_, height_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_.frame());
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  for (std::size_t k = 3; k < image.rgba.size(); k += 4) image.rgba[k] = 255;
  return image;
}

}  // namespace gridshell::window
