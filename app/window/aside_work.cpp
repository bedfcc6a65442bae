#include "app/window/aside_work.h"

#include <utility>

namespace gridshell::window {

AsideWork::~AsideWork() {
  stop();
  wait();
}

void AsideWork::begin(Work work, const std::filesystem::path& target) {
  wait();
  watch_.emplace();
  target_ = target;
  said_.clear();
  made_.reset();
  under_way_ = true;
  thread_ = std::thread([this, work = std::move(work)] {
    const auto heard = [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      said_ = line;
    };
    auto made = work(heard, *watch_);
    const std::lock_guard lock(mutex_);
    made_ = std::move(made);
    under_way_ = false;
  });
}

void AsideWork::stop() {
  if (watch_) watch_->cancel();
}

bool AsideWork::under_way() const {
  const std::lock_guard lock(mutex_);
  return under_way_;
}

bool AsideWork::idle() const {
  const std::lock_guard lock(mutex_);
  return !under_way_ && !made_;
}

std::string AsideWork::standing() const {
  const std::lock_guard lock(mutex_);
  return said_;
}

std::optional<AsideWork::End> AsideWork::take_end() {
  const std::lock_guard lock(mutex_);
  if (!made_) return std::nullopt;
  return End{target_, *std::exchange(made_, std::nullopt), said_};
}

void AsideWork::wait() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace gridshell::window
