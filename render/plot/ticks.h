// Numbers and ticks on an axis, a colour bar, a caption. No number depends on the locale; minus is
// the true minus sign (U+2212), powers of ten are raised.
#pragma once

#include <string>
#include <vector>

namespace gridshell::render {

/// A tick; minor ones bear no label.
struct Tick {
  double value = 0;
  std::string label;  ///< marked text (render/plot/text.h)
  bool major = true;
};

/// `value` with a fixed number of decimals: "−0.05"; never "−0.00".
std::string fixed(double value, int decimals);

/// `value` to so many significant digits, as "0.0123", "1250" or "1.2 × 10^{−7}"; "–" if not
/// finite.
std::string scientific(double value, int digits);

/// The smallest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is >= value (> 0).
double nice_ceiling(double value);

/// Ticks within [low, high] at multiples of 1, 2 or 5 times a power of ten, about `count` major
/// ones and never fewer than two where that is possible, with minor ticks between.
std::vector<Tick> linear_ticks(double low, double high, int count);

/// Ticks within [low, high], 0 < low < high: a label at each power of ten (or each n-th, to keep
/// about `count`), minor ticks at 2 … 9; where less than two powers of ten are within, labels at
/// 1, 2, 5, and linear ticks where even those are too few.
std::vector<Tick> log_ticks(double low, double high, int count);

}  // namespace gridshell::render
