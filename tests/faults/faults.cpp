#include "tests/faults/faults.h"

#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

#include "engine/solve/linear_solver.h"

namespace {

std::atomic<int> watched{-1};
std::atomic<long> count{0}, fatal{0};

bool fails(Call kind) {
  if (watched.load(std::memory_order_relaxed) != int(kind)) return false;
  return ++count == fatal.load(std::memory_order_relaxed);
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool is_file(int descriptor) {
  struct stat about {};
  return fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
}

}  // namespace

void fail_call(Call kind, long k) {
  count = 0;
  fatal = k;
  watched = int(kind);
}

long calls_counted() { return count; }

// symbols of the program itself come before the library's

extern "C" ssize_t write(int descriptor, const void* data, size_t size) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  if (is_file(descriptor) && fails(Call::write)) return errno = ENOSPC, -1;
  return real(descriptor, data, size);
}

extern "C" ssize_t pwrite(int descriptor, const void* data, size_t size, off_t at) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  if (fails(Call::write)) return errno = ENOSPC, -1;
  return real(descriptor, data, size, at);
}

extern "C" int fdatasync(int descriptor) {
  static const auto real = next<int (*)(int)>("fdatasync");
  if (fails(Call::sync)) return errno = EIO, -1;
  return real(descriptor);
}

extern "C" int rename(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  if (fails(Call::rename)) return errno = EIO, -1;
  return real(from, to);
}

extern "C" int renameat2(int a, const char* from, int b, const char* to, unsigned flags) {
  static const auto real = next<int (*)(int, const char*, int, const char*, unsigned)>("renameat2");
  if (fails(Call::rename)) return errno = EIO, -1;
  return real(a, from, b, to, flags);
}

extern "C" int mkdir(const char* path, mode_t mode) {
  static const auto real = next<int (*)(const char*, mode_t)>("mkdir");
  if (fails(Call::mkdir)) return errno = EIO, -1;
  return real(path, mode);
}

namespace {

using namespace gridshell;

class FailingSolver final : public LinearSolver {
 public:
  explicit FailingSolver(std::unique_ptr<LinearSolver> real) : real_(std::move(real)) {}
  Inertia factor(const BlockHessian& hessian, double shift) override {
    const Inertia inertia = real_->factor(hessian, shift);
    return fails(Call::factorisation) ? Inertia{} : inertia;
  }
  void solve(Eigen::Matrix3Xd& right_hand_side) const override {
    real_->solve(right_hand_side);
    if (fails(Call::solve)) right_hand_side.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  long long blocks() const override { return real_->blocks(); }

 private:
  std::unique_ptr<LinearSolver> real_;
};

}  // namespace

// the linker (--wrap, tests/tests.cmake) leads every call of make_linear_solver here, and calls of
// the second name to the real one
std::unique_ptr<LinearSolver> real_linear_solver(const Model& model) __asm__(
    "__real__ZN9gridshell18make_linear_solverERKNS_5ModelE");
std::unique_ptr<LinearSolver> failing_linear_solver(const Model& model) __asm__(
    "__wrap__ZN9gridshell18make_linear_solverERKNS_5ModelE");
std::unique_ptr<LinearSolver> failing_linear_solver(const Model& model) {
  return std::make_unique<FailingSolver>(real_linear_solver(model));
}

void* operator new(std::size_t size) {
  void* memory = fails(Call::allocation) ? nullptr : std::malloc(size);
  if (!memory) throw std::bad_alloc();
  return memory;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return fails(Call::allocation) ? nullptr : std::malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
