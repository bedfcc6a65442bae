// Targets of the tables of searches, the logs of sweeps, and pictures.
#include <fmt/format.h>

#include <array>

#include "engine/core/file_io.h"
#include "engine/record/states.h"
#include "engine/record/sweep_results.h"
#include "render/gl/image.h"
#include "tests/fuzz/targets.h"
#include "tests/temporary_folder.h"

namespace gridshell::fuzz {
namespace {

using namespace gridshell::record;

/// Removes the text before the next `end`, and `end` with it; returns the text.
std::string_view taken(std::string_view& bytes, std::string_view end) {
  const auto at = bytes.find(end);
  const auto part = bytes.substr(0, at);
  bytes.remove_prefix(at == bytes.npos ? bytes.size() : at + end.size());
  return part;
}

}  // namespace

void states(std::string_view bytes) {
  static const TemporaryFolder folder;
  for (const char* name : std::array{states_name, search_name, transitions_name, barriers_name}) {
    const auto part = taken(bytes, "=====\n");
    std::filesystem::remove(folder / name);
    if (!part.empty()) (void)write_file(folder / name, std::string(part));
  }
  if (const auto tables = read_state_tables(folder)) {
    (void)states_to_draw(tables->rows, 5);
    (void)write_state_tables(folder, *tables);
  }
}

void sweep_log(std::string_view bytes) {
  // a fuzzer cannot guess checksums, without which every line is refused: lines that have none get
  // theirs
  std::string text;
  while (!bytes.empty()) {
    std::string line(taken(bytes, "\n"));
    if (line.ends_with('}') && line.find("\"sum\"") == line.npos) {
      line.pop_back();
      line += fmt::format(",\"sum\":\"{:016x}\"}}", Checksum::of(line));
    }
    text += line + '\n';
  }
  const InputFile file(text);
  (void)read_sweep_log(file.path());
}

void png(std::string_view bytes) {
  const InputFile file(bytes);
  (void)render::read_png(file.path());
}

}  // namespace gridshell::fuzz
