// Text with markup, and numbers and ticks as text. Sub- and superscripts have an explicit size and
// rise, in units of the font, since Pango's own <sub> would scale its size by the canvas once more.
#pragma once

#include <string>
#include <vector>

namespace gridshell::render {

/// A piece of text of one look.
struct TextRun {
  std::string text;
  int level = 0;  ///< -1: lowered; 0: on the line; 1: raised
  bool slanted = false;
};

/// Size of a lowered or raised piece, and its shift, over the font's size.
inline constexpr double script_size = 0.72, lowered_by = 0.18, raised_by = 0.36;

/// The pieces of a text with markup: `_{...}` (lowered), `^{...}` (raised), `*...*` (slanted), and
/// `\` before a character that is not markup. An unpaired mark is an ordinary character.
std::vector<TextRun> parse_marked(const std::string& marked);

/// The text without its markup.
std::string without_marks(const std::string& marked);

/// A name of a file with spaces instead of underscores.
std::string spaced(std::string word);

// Numbers on axes, colour bars and in captions. They do not depend on the locale; minus is the
// minus sign U+2212, and powers of ten are raised.

/// A tick of an axis; minor ones have no label.
struct Tick {
  double value = 0;
  std::string label;  ///< text with markup
  bool major = true;
};

/// `value` with a fixed number of decimals: "−0.05"; never "−0.00".
std::string fixed(double value, int decimals);

/// `value` to so many significant digits, as "0.0123", "1250" or "1.2 × 10^{−7}"; "–" if not
/// finite.
std::string scientific(double value, int digits);

/// The smallest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is >= value (> 0).
double nice_ceiling(double value);

/// A length: "45.7 mm", from 1000 mm "1.756 m".
std::string length_text(double mm);

/// The length of a scale bar for an object of half size `size_mm`: the given length or, if that is
/// much shorter or longer than the object, a round one. 0 remains 0.
inline double fitted_scale_bar(double requested_mm, double size_mm) {
  const bool fits = requested_mm >= 0.03 * size_mm && requested_mm <= 2 * size_mm;
  return requested_mm <= 0 || fits ? requested_mm : nice_ceiling(0.2 * size_mm);
}

/// Ticks within [low, high] at multiples of 1, 2 or 5 times a power of ten, about `count` major
/// ones and never fewer than two where that is possible, with minor ticks between.
std::vector<Tick> linear_ticks(double low, double high, int count);

/// Ticks within [low, high], 0 < low < high, with about `count` labels: one at each power of ten or
/// each n-th, and minor ticks at 2 … 9. If [low, high] contains less than two powers of ten, labels
/// are at 1, 2 and 5; if even those are less than two, ticks are linear.
std::vector<Tick> log_ticks(double low, double high, int count);

}  // namespace gridshell::render
