#include "render/canvas/text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

#include "render/canvas/canvas.h"

namespace gridshell::render {
namespace {

// position of the unescaped `mark` at or after `from`, or npos
std::size_t find_mark(const std::string& text, char mark, std::size_t from) {
  for (std::size_t k = from; k < text.size(); ++k) {
    if (text[k] == '\\')
      ++k;
    else if (text[k] == mark)
      return k;
  }
  return std::string::npos;
}

void append(std::vector<TextRun>& runs, const TextRun& look, char letter) {
  if (runs.empty() || runs.back().level != look.level || runs.back().slanted != look.slanted)
    runs.push_back({"", look.level, look.slanted});
  runs.back().text += letter;
}

void parse(const std::string& text, TextRun look, std::vector<TextRun>& runs) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '\\' && k + 1 < text.size()) {
      append(runs, look, text[++k]);
      continue;
    }
    const bool script = (c == '_' || c == '^') && k + 1 < text.size() && text[k + 1] == '{';
    if (script || c == '*') {
      const std::size_t start = k + (script ? 2 : 1);
      const std::size_t end = find_mark(text, script ? '}' : '*', start);
      if (end != std::string::npos) {
        TextRun inner = look;
        if (script)
          inner.level = c == '_' ? -1 : 1;
        else
          inner.slanted = true;
        parse(text.substr(start, end - start), inner, runs);
        k = end;
        continue;
      }
    }
    append(runs, look, c);
  }
}

std::string with_minus(std::string text) {
  if (!text.empty() && text[0] == '-') text.replace(0, 1, "−");
  return text;
}

// a value that rounds to zero loses its sign
double without_negative_zero(double value, int decimals) {
  return std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value;
}

std::string power_of_ten(int exponent) { return "10^{" + fixed(exponent, 0) + "}"; }

struct Step {
  double size;
  int parts;  // minor intervals within it
};

// the least of 1, 2 or 5 times a power of ten that is at least the requested size
Step nice_step(double requested) {
  const double power = std::pow(10.0, std::floor(std::log10(requested)));
  const double ratio = requested / power;
  if (ratio <= 1.0 + 1e-9) return {power, 5};
  if (ratio <= 2.0 + 1e-9) return {2 * power, 4};
  if (ratio <= 5.0 + 1e-9) return {5 * power, 5};
  return {10 * power, 5};
}

// first and last multiples of `size` in [low, high], to within round-off
std::pair<long, long> multiples(double low, double high, double size) {
  return {long(std::ceil(low / size - 1e-9)), long(std::floor(high / size + 1e-9))};
}

std::string linear_label(double value, double step, double largest) {
  const int step_exponent = int(std::floor(std::log10(step) + 1e-9));
  const int exponent = int(std::floor(std::log10(largest) + 1e-9));
  if (exponent < 5 && step_exponent >= -4) return fixed(value, std::max(0, -step_exponent));
  if (std::abs(value) < step * 1e-6) return "0";
  return fixed(value / std::pow(10.0, exponent), std::max(0, exponent - step_exponent)) + " × " +
         power_of_ten(exponent);
}

}  // namespace

std::string plain(const std::string& text) {
  std::string escaped;
  for (char c : text) {
    if (std::strchr("_^*{}\\", c) && c != '\0') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::vector<TextRun> parse_marked(const std::string& marked) {
  std::vector<TextRun> runs;
  parse(marked, {}, runs);
  return runs;
}

std::string without_marks(const std::string& marked) {
  std::string letters;
  for (const TextRun& run : parse_marked(marked)) letters += run.text;
  return letters;
}

std::string spaced(std::string word) {
  std::replace(word.begin(), word.end(), '_', ' ');
  return word;
}

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  return with_minus(fmt::format("{:.{}f}", without_negative_zero(value, decimals), decimals));
}

std::string length_text(double mm) {
  return mm >= 1000 ? fixed(1e-3 * mm, 3) + " m" : fixed(mm, 1) + " mm";
}

std::string scientific(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  // round first: 9.99 to two digits is 10
  const std::string rounded = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = rounded.find('e');
  const int exponent = std::stoi(rounded.substr(e + 1));
  if (exponent >= -3 && exponent < 5) return fixed(value, std::max(0, digits - 1 - exponent));
  return with_minus(rounded.substr(0, e)) + " × " + power_of_ten(exponent);
}

double nice_ceiling(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (double factor : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0})
    if (value <= factor * power * (1 + 1e-9)) return factor * power;
  return 10 * power;
}

std::vector<Tick> linear_ticks(double low, double high, int count) {
  if (!(high > low) || !std::isfinite(high - low)) return {};
  Step step = nice_step((high - low) / std::max(1, count));
  auto [first, last] = multiples(low, high, step.size);
  for (int attempt = 0; attempt < 3 && last - first < 1; ++attempt) {
    step = nice_step(step.size / 2.6);
    std::tie(first, last) = multiples(low, high, step.size);
  }
  const double largest = std::max(std::abs(low), std::abs(high));
  const auto [minor_first, minor_last] = multiples(low, high, step.size / step.parts);
  std::vector<Tick> ticks;
  for (long k = minor_first; k <= minor_last; ++k) {
    const bool major = k % step.parts == 0;
    const double value = major ? double(k / step.parts) * step.size : k * step.size / step.parts;
    ticks.push_back({value, major ? linear_label(value, step.size, largest) : "", major});
  }
  return ticks;
}

std::vector<Tick> log_ticks(double low, double high, int count) {
  if (!(low > 0) || !(high > low) || !std::isfinite(high)) return {};
  const int first = int(std::ceil(std::log10(low) - 1e-9));
  const int last = int(std::floor(std::log10(high) + 1e-9));
  const int decades = last - first + 1;
  const int every = std::max(1, (decades + count - 1) / std::max(1, count));
  std::vector<Tick> ticks;
  int labels = 0;
  for (int exponent = first - 1; exponent <= last; ++exponent)
    for (int factor = 1; factor <= 9; ++factor) {
      const double value = factor * std::pow(10.0, exponent);
      if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9)) continue;
      const bool wide = decades >= 2;
      const bool major = wide ? factor == 1 && (exponent - first) % every == 0
                              : factor == 1 || factor == 2 || factor == 5;
      // if only every n-th power of ten has a label, the others are the minor ticks
      if (every > 1 && factor != 1) continue;
      std::string label;
      if (major) label = wide ? power_of_ten(exponent) : scientific(value, 1);
      labels += major;
      ticks.push_back({value, label, major});
    }
  return labels < 2 ? linear_ticks(low, high, count) : ticks;
}

}  // namespace gridshell::render
