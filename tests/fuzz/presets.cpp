#include <cstdio>
#include <cstdlib>

#include "engine/preset/point_file.h"
#include "engine/preset/reader.h"
#include "engine/preset/writer.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace gridshell::fuzz {
namespace {

[[noreturn]] void complain(const char* what, const std::string& text) {
  std::fprintf(stderr, "%s\n%s\n", what, text.c_str());
  std::abort();
}

}  // namespace

void preset(std::string_view bytes) {
  std::vector<preset::Override> overrides;
  if (bytes.starts_with("--set ")) {
    const auto end = bytes.find('\n');
    const auto change = preset::parse_override(std::string(bytes.substr(6, end - 6)));
    if (change) overrides.push_back(*change);
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
  }
  // no file beside it: points by name are looked for in a folder that is not there
  const auto read =
      preset::read_preset_text(std::string(bytes), "/nonexistent/x.toml", "x", overrides);
  if (!read) {
    if (read.error().message.empty()) complain("refused without a word", std::string(bytes));
    return;
  }
  const std::string text = preset::to_toml(*read);
  const auto again = preset::read_preset_text(text, "/nonexistent/x.toml", "x");
  if (!again) complain("does not read its own text", again.error().message + "\n" + text);
  if (preset::to_toml(*again) != text) complain("comes back as another preset", text);
}

void points(std::string_view bytes) {
  const InputFile file(bytes);
  (void)preset::read_points(file.path(), {"x", "y"});
  (void)preset::read_points(file.path(), {"x", "y", "z"});
  (void)preset::read_points(file.path(), {"family", "x"}, {{"u", "v"}, {}});
}

}  // namespace gridshell::fuzz
