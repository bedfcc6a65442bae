#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>

#include "app/console.h"
#include "app/interrupt.h"

namespace gridshell::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string time_text(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string left_text(const Standing& at) {
  return std::isnan(at.seconds_left) || at.fraction >= 1
             ? ""
             : fmt::format(", {} left", time_text(at.seconds_left));
}

}  // namespace

Standing standing(const std::vector<Phase>& phases, std::size_t current, double fraction,
                  double elapsed) {
  double all = 0, before = 0, after = 0;
  for (std::size_t k = 0; k < phases.size(); ++k) {
    all += phases[k].expected_seconds;
    if (k < current) before += phases[k].expected_seconds;
    if (k > current) after += phases[k].expected_seconds;
  }
  const double own = phases[current].expected_seconds;
  Standing at{all > 0 ? (before + own * fraction) / all : 0,
              std::numeric_limits<double>::quiet_NaN()};
  // too early to tell how fast this phase is
  if (fraction < 0.02 || elapsed < 0.5) return at;
  const double whole = elapsed / fraction;
  at.seconds_left = whole - elapsed + (own > 0 ? after * whole / own : after);
  return at;
}

std::string bar_text(const Standing& at, const std::string& label, int width) {
  const int full = std::clamp(int(at.fraction * width), 0, width);
  std::string bar(std::size_t(full), '=');
  if (full < width) bar += '>';
  bar.resize(std::size_t(width), ' ');
  return fmt::format("[{}] {:3d} %  {}{}", bar, int(at.fraction * 100), label, left_text(at));
}

Progress::Show Progress::show_for(bool quiet) {
  return quiet ? Show::nothing : isatty(STDERR_FILENO) ? Show::bar : Show::lines;
}

Progress::Progress(std::vector<Phase> phases, Show show, std::function<void()> last_words)
    : phases_(std::move(phases)), show_(show), last_words_(std::move(last_words)) {
  thread_ = std::thread([this] { loop(); });
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  wake_.notify_all();
  thread_.join();
  // the line of the bar is free again
  if (bar_open_) std::fputs("\r\033[K", stderr);
}

Watch& Progress::next_phase() {
  const std::lock_guard lock(mutex_);
  watches_.push_back(std::make_unique<Watch>());
  phase_began_ = Clock::now();
  if (interrupted_) watches_.back()->cancel();
  return *watches_.back();
}

void Progress::loop() {
  std::unique_lock lock(mutex_);
  while (!finished_) {
    stop_if_asked();
    try {
      if (!watches_.empty() && !interrupted_) show_now();
    } catch (const std::exception&) {
      // a line that does not fit into memory is not worth the work
    }
    wake_.wait_for(lock, std::chrono::milliseconds(50));
  }
}

void Progress::stop_if_asked() {
  if (!interrupted_ && interrupt_came()) {
    interrupted_ = true;
    interrupted_at_ = Clock::now();
    if (!watches_.empty()) watches_.back()->cancel();
  }
  // what is finished is whole, so the program may end
  const bool draws = !watches_.empty() && phases_[watches_.size() - 1].draws;
  if (interrupted_ && draws && seconds_since(interrupted_at_) > 0.5) {
    if (bar_open_) std::fputs("\r\033[K", stderr);
    try {
      last_words_();
    } catch (const std::exception&) {
      // the folder says by itself what it holds
    }
    _exit(ExitCode::interrupted);
  }
}

void Progress::show_now() {
  const auto current = watches_.size() - 1;
  const auto at =
      standing(phases_, current, watches_.back()->progress(), seconds_since(phase_began_));
  const auto& label = phases_[current].label;
  if (show_ == Show::bar) {
    std::fprintf(stderr, "\r%s\033[K", bar_text(at, label, 40).c_str());
    bar_open_ = true;
  }
  const int tenth = int(at.fraction * 10);
  if (show_ == Show::lines && tenth > tenth_shown_) {
    std::fprintf(stderr, "%d %%  %s%s\n", tenth * 10, label.c_str(), left_text(at).c_str());
    tenth_shown_ = tenth;
  }
}

}  // namespace gridshell::app
