#include "app/window/numbers_file.h"

namespace gridshell::window {

bool NumbersFile::write(const double* numbers, std::size_t count) {
  if (count == 0) return true;
  if (!file_) file_.reset(std::tmpfile());
  const bool written = file_ && ::fseeko(file_.get(), end_, SEEK_SET) == 0 &&
                       std::fwrite(numbers, sizeof(double), count, file_.get()) == count &&
                       std::fflush(file_.get()) == 0;
  if (written) end_ += std::int64_t(count * sizeof(double));
  return written;
}

bool NumbersFile::read(std::int64_t at, double* numbers, std::size_t count) const {
  if (count == 0) return true;
  return file_ && ::fseeko(file_.get(), at, SEEK_SET) == 0 &&
         std::fread(numbers, sizeof(double), count, file_.get()) == count;
}

}  // namespace gridshell::window
