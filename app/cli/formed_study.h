// Commands that find something out about a formed shell and show how it moves: `load`, `modes`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/delivery.h"
#include "app/cli/options.h"
#include "app/cli/pictures.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// What was found about one run's shell.
struct FormedStudy {
  std::vector<std::pair<std::string, std::string>> files;  ///< names and texts
  std::string text;                                        ///< for the terminal, indented lines
  record::Trajectory state;                                ///< the shell, one frame
  record::Summary summary;
  record::FrameList moves;            ///< how it moves (moved_by), a still each
  std::vector<std::string> captions;  ///< of these, marked text
  /// Pictures more; may be empty.
  std::function<Result<void>(render::Renderer&, const std::filesystem::path& folder, Progress&)>
      draw_more = {};
};

struct FormedCommand {
  std::string folder_end, finds;  ///< "_modes", "natural frequencies"
  std::function<Result<FormedStudy>(const preset::Preset&, Watch&)> find;
  double paths = 1;                                  ///< it takes as long as so many
  std::function<int(const preset::Preset&)> stills;  ///< that it may draw
  std::function<std::vector<Phase>(const preset::Preset&)> drawn_more = {};  ///< phases of these
};

/// Does so for every run of a preset: its tables, preset and summary, then stills of its moves in
/// OUT/<preset>_1.png ... Prints what was found; the exit code.
Result<int> study_formed(const Options& options, const FormedCommand& command);

}  // namespace gridshell::app
