#include "render/gl/image.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace gridshell::fuzz {

void png(std::string_view bytes) {
  const InputFile file(bytes);
  (void)render::read_png(file.path());
}

}  // namespace gridshell::fuzz
