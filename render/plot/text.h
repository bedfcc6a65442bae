// Marked text to Pango's attributes. Sub- and superscripts bear an explicit size and rise, in
// units of the font: Pango's own <sub> scales its size by the canvas once more.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gridshell::render {

/// A piece of text of one look.
struct TextRun {
  std::string text;
  int level = 0;  ///< -1 lowered, 0 on the line, 1 raised
  bool slanted = false;
};

/// Size of a lowered or raised piece, and its shift, over the font's size.
inline constexpr double script_size = 0.72, lowered_by = 0.18, raised_by = 0.36;

/// `_{...}`, `^{...}`, `*...*` and `\` before a character that is to be taken literally. An
/// unpaired mark is taken literally.
std::vector<TextRun> parse_marked(const std::string& marked);

/// The letters alone.
std::string without_marks(const std::string& marked);

/// A word of a file as a picture says it: with spaces.
std::string spaced(std::string word);

}  // namespace gridshell::render
