#include "engine/preset/field_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <cmath>
#include <sstream>

namespace gridshell::preset {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

std::string in_quotes(const std::string& text) {
  std::ostringstream out;
  const toml::value<std::string> value(text);
  out << toml::toml_formatter{value, toml::format_flags::none};
  return out.str();
}

// shortest text that reads back as the same double, always a TOML float
std::string real_text(double value) {
  auto text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string bounds_text(const Range& range) {
  const bool below = std::isfinite(range.low), above = std::isfinite(range.high);
  if (below && above && !range.low_open)
    return fmt::format(" from {} to {}", range.low, range.high);
  std::string text;
  if (below) text += fmt::format(" {} {}", range.low_open ? ">" : ">=", range.low);
  if (above) text += fmt::format("{} <= {}", below ? " and" : "", range.high);
  return text;
}

std::string words_text(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + fmt::format("\"{}\"", words[k]);
  return text;
}

std::string points_text(const PointList& kind, const Points& points) {
  std::vector<std::string> items;
  for (const auto& point : points) {
    std::vector<std::string> numbers;
    for (std::size_t k = 0; k < point.size(); ++k) {
      const auto words = kind.words_of(k);
      numbers.push_back(words.empty() ? real_text(point[k])
                                      : in_quotes(words.at(std::size_t(point[k]))));
    }
    items.push_back(fmt::format("[{}]", fmt::join(numbers, ", ")));
  }
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string reals_text(const std::vector<double>& values) {
  std::vector<std::string> items;
  for (const double value : values) items.push_back(real_text(value));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string rows_text(const Points& rows) {
  std::vector<std::string> items;
  for (const auto& row : rows) items.push_back(reals_text(row));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string surface_text(const SurfaceData& surface) {
  if (surface.empty()) return "\"\"";
  if (!surface.is_mesh())
    return fmt::format("{{x_mm = {}, y_mm = {}, z_mm = {}}}", reals_text(surface.x),
                       reals_text(surface.y), rows_text(surface.z));
  std::vector<std::string> items;
  for (const auto& [a, b, c] : surface.triangles)
    items.push_back(fmt::format("[{}, {}, {}]", a, b, c));
  return fmt::format("{{vertices_mm = {}, triangles = [{}]}}", rows_text(surface.vertices),
                     fmt::join(items, ", "));
}

std::string integers_text(const std::vector<int>& values) {
  return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string network_text(const NetworkData& network) {
  if (network.empty()) return "\"\"";
  std::vector<std::string> rods;
  for (const auto& rod : network.rods) rods.push_back(integers_text(rod));
  auto text = fmt::format("{{points_mm = {}, rods = [{}]", rows_text(network.points),
                          fmt::join(rods, ", "));
  if (!network.diameters.empty())
    text += fmt::format(", diameters_mm = {}", reals_text(network.diameters));
  if (!network.supports.empty())
    text += fmt::format(", supports_mm = {}", rows_text(network.supports));
  if (!network.springs.empty())
    text += fmt::format(", springs_N_per_mm = {}", rows_text(network.springs));
  if (!network.free.empty()) text += fmt::format(", free = {}", integers_text(network.free));
  return text + "}";
}

std::string axes_text(const std::vector<SweepAxis>& axes) {
  std::vector<std::string> items;
  for (const auto& axis : axes)
    items.push_back(fmt::format("{} = [{}]", axis.key, fmt::join(axis.values, ", ")));
  return fmt::format("{{{}}}", fmt::join(items, ", "));
}

}  // namespace

std::string name_of(const Field& field) {
  return field.table.empty() ? field.key : fmt::format("[{}] {}", field.table, field.key);
}

std::string allowed(const Field& field) {
  return std::visit(
      Overloaded{
          [](const Real& k) { return "a number" + bounds_text(k.range); },
          [](const Integer& k) { return "an integer" + bounds_text(k.range); },
          [](const Flag&) { return std::string("true or false"); },
          [](const Text&) { return std::string("a string"); },
          [](const ColourText&) {
            return std::string("a colour \"#rrggbb\", \"transparent\" or \"\"");
          },
          [](const Word& k) { return words_text(k.words); },
          [](const IntegerPair& k) { return "two integers, each" + bounds_text(k.range); },
          [](const IntegerList& k) { return "a list of integers" + bounds_text(k.range); },
          [](const RealList& k) {
            const std::string bounds = bounds_text(k.range);
            return "a list of numbers" + (bounds.empty() ? bounds : ", each" + bounds);
          },
          [](const OptionalInteger& k) {
            return "an integer" + bounds_text(k.range) + ", or \"none\"";
          },
          [](const TextList&) { return std::string("a list of strings"); },
          [](const AxisList&) {
            return std::string(
                "a table of keys in dotted form, each a list of values or { from, to, count }");
          },
          [](const PointList& k) {
            return fmt::format("a list of points [{}], or the name of a file with one a line",
                               fmt::join(k.coordinates, ", "));
          },
          [](const SurfaceText&) {
            return std::string(
                "the name of a file, a table {x_mm, y_mm, z_mm} of a grid or {vertices_mm, "
                "triangles}, or \"\"");
          },
          [](const NetworkText&) {
            return std::string(
                "the name of a file, a table {points_mm, rods, diameters_mm, supports_mm, "
                "springs_N_per_mm, free}, or \"\"");
          },
          [](const WordList& k) { return "a list of " + words_text(k.words); },
      },
      field.kind);
}

std::string value_text(const Field& field, const Preset& preset) {
  // the accessors reach for writing; nothing is written here
  auto& from = const_cast<Preset&>(preset);
  return std::visit(Overloaded{
                        [&](const Real& k) { return real_text(k.in(from)); },
                        [&](const Integer& k) { return std::to_string(k.in(from)); },
                        [&](const Flag& k) { return std::string(k.in(from) ? "true" : "false"); },
                        [&](const Text& k) { return in_quotes(k.in(from)); },
                        [&](const ColourText& k) { return in_quotes(k.in(from)); },
                        [&](const Word& k) { return in_quotes(k.words.at(k.get(preset))); },
                        [&](const IntegerPair& k) {
                          return fmt::format("[{}, {}]", k.in(from)[0], k.in(from)[1]);
                        },
                        [&](const IntegerList& k) { return integers_text(k.in(from)); },
                        [&](const RealList& k) { return reals_text(k.in(from)); },
                        [&](const OptionalInteger& k) {
                          const auto& value = k.in(from);
                          return value ? std::to_string(*value) : std::string("\"none\"");
                        },
                        [&](const TextList& k) {
                          std::vector<std::string> items;
                          for (const auto& text : k.in(from)) items.push_back(in_quotes(text));
                          return fmt::format("[{}]", fmt::join(items, ", "));
                        },
                        [&](const AxisList& k) { return axes_text(k.in(from)); },
                        [&](const WordList& k) {
                          std::vector<std::string> items;
                          for (const int index : k.get(preset))
                            items.push_back(in_quotes(k.words.at(std::size_t(index))));
                          return fmt::format("[{}]", fmt::join(items, ", "));
                        },
                        [&](const PointList& k) { return points_text(k, k.in(from)); },
                        [&](const SurfaceText& k) { return surface_text(k.in(from)); },
                        [&](const NetworkText& k) { return network_text(k.in(from)); },
                    },
                    field.kind);
}

}  // namespace gridshell::preset
