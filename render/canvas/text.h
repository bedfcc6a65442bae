// Marked text to Pango's attributes. Sub- and superscripts bear an explicit size and rise, in
// units of the font: Pango's own <sub> scales its size by the canvas once more.
#pragma once

#include <string>
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

// Numbers and ticks on an axis, a colour bar, a caption. No number depends on the locale; minus is
// the true minus sign (U+2212), powers of ten are raised.

/// A tick; minor ones bear no label.
struct Tick {
  double value = 0;
  std::string label;  ///< marked text (render/canvas/text.h)
  bool major = true;
};

/// `value` with a fixed number of decimals: "−0.05"; never "−0.00".
std::string fixed(double value, int decimals);

/// `value` to so many significant digits, as "0.0123", "1250" or "1.2 × 10^{−7}"; "–" if not
/// finite.
std::string scientific(double value, int digits);

/// The smallest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is >= value (> 0).
double nice_ceiling(double value);

/// "45.7 mm"; from a metre on "1.756 m".
std::string length_text(double mm);

/// The length of a scale bar next to a thing of half size `size_mm`: the given one, or, where that
/// would be a dot or longer than the thing, a round length; 0 stays 0.
inline double scale_bar_beside(double wanted_mm, double size_mm) {
  const bool fits = wanted_mm >= 0.03 * size_mm && wanted_mm <= 2 * size_mm;
  return wanted_mm <= 0 || fits ? wanted_mm : nice_ceiling(0.2 * size_mm);
}

/// Ticks within [low, high] at multiples of 1, 2 or 5 times a power of ten, about `count` major
/// ones and never fewer than two where that is possible, with minor ticks between.
std::vector<Tick> linear_ticks(double low, double high, int count);

/// Ticks within [low, high], 0 < low < high: a label at each power of ten (or each n-th, to keep
/// about `count`), minor ticks at 2 … 9; where less than two powers of ten are within, labels at
/// 1, 2, 5, and linear ticks where even those are too few.
std::vector<Tick> log_ticks(double low, double high, int count);

}  // namespace gridshell::render
