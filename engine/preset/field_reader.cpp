// Reads the values of keys from TOML: one overload per type of member.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "engine/core/file_io.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/network_file.h"
#include "engine/formats/outline_file.h"
#include "engine/formats/point_file.h"
#include "engine/formats/surface_file.h"
#include "engine/preset/likely_surface.h"
#include "engine/preset/toml_reader.h"

namespace gridshell::preset {
namespace {

// a finite number, written as an integer or a float
std::optional<double> real_of(const toml::node& value) {
  if (const auto* real = value.as_floating_point(); real && std::isfinite(real->get()))
    return real->get();
  if (const auto* integer = value.as_integer()) return double(integer->get());
  return std::nullopt;
}

// only the magnitude of coordinates is limited: a value meant as zero is often slightly off zero
std::string points_error(const Points& points) {
  constexpr std::size_t most_points = 100000;
  if (points.size() > most_points)
    return fmt::format("{} points, more than {}", points.size(), most_points);
  for (const auto& point : points)
    for (const double value : point)
      if (!(std::abs(value) <= largest_magnitude))
        return "a number too large to compute with (above 1e9)";
  return "";
}

// the index of a name among the allowed ones
std::optional<double> index_of(const toml::node& value, const std::vector<std::string>& words) {
  const auto* text = value.as_string();
  if (!text) return std::nullopt;
  const auto found = std::ranges::find(words, text->get());
  if (found == words.end()) return std::nullopt;
  return double(found - words.begin());
}

std::string type_text(const toml::node& value) {
  if (value.is_floating_point()) return real_of(value) ? "a number" : "not finite";
  if (value.is_integer()) return "an integer";
  if (value.is_string()) return "a string";
  if (value.is_boolean()) return "a boolean";
  if (value.is_array()) return "a list";
  if (value.is_table()) return "a table";
  return "a date or time";
}

// parts of a surface or network: the magnitude of coordinates is limited; integers are indices
std::string read_part(const toml::node& value, double& number) {
  const auto real = real_of(value);
  number = real.value_or(0);
  return real && std::abs(*real) <= largest_magnitude ? "" : "expected numbers of at most 1e9";
}
std::string read_part(const toml::node& value, int& number) {
  const auto whole = value.is_integer() ? value.as_integer()->get() : -1;
  number = int(whole);
  return whole >= 0 && whole <= 1000000000 ? "" : "expected whole numbers from 0 to 1e9";
}
std::string read_part(const toml::node& value, RodValue& of) {
  const auto* row = value.as_array();
  if (!row || row->size() != 3 || !row->at(1).is_string()) return "expected rows [rod, key, value]";
  of.key = row->at(1).as_string()->get();
  const auto wrong = read_part(row->at(0), of.rod);
  return wrong.empty() ? read_part(row->at(2), of.value) : wrong;
}
template <class List>
std::string read_part(const toml::node& value, List& list) {
  const auto* items = value.as_array();
  if (!items) return "expected lists";
  if constexpr (requires { list.emplace_back(); })
    list.resize(items->size());
  else if (items->size() != list.size())
    return fmt::format("expected lists of {}", list.size());
  for (std::size_t k = 0; k < items->size(); ++k)
    if (auto wrong = read_part((*items)[k], list[k]); !wrong.empty()) return wrong;
  return "";
}

template <class Data>
std::string read_parts(const toml::table& table, Data& data) {
  std::string wrong;
  each_part(data, table.contains("triangles"), [&](const char* key, auto& part, bool needed) {
    if (!wrong.empty() || (!needed && !table.contains(key))) return;
    const auto* value = table.get(key);
    const bool list = value && value->is_array();
    const std::string_view name(key);
    const std::string bare(name.ends_with("_mm") ? name.substr(0, name.size() - 3) : "");
    wrong = list ? read_part(*value, part)
                 : fmt::format("no list {}{}", key,
                               table.contains(bare)
                                   ? fmt::format(" (it has {}: add the unit to the name)", bare)
                                   : "");
    if (list && !wrong.empty()) wrong = fmt::format("{}: {}", key, wrong);
  });
  return wrong;
}

std::string surface_text(const SurfaceData& surface) {
  if (!surface.is_mesh())
    return fmt::format("heights on a grid of {} x {}, {:.6g} x {:.6g} mm", surface.x.size(),
                       surface.y.size(), surface.x.back() - surface.x.front(),
                       surface.y.back() - surface.y.front());
  Eigen::AlignedBox3d box;
  for (const auto& at : surface.vertices) box.extend(Eigen::Vector3d(at[0], at[1], at[2]));
  const Eigen::Vector3d size = box.sizes();
  return fmt::format("{} triangles, {} vertices, {:.6g} x {:.6g} x {:.6g} mm",
                     surface.triangles.size(), surface.vertices.size(), size.x(), size.y(),
                     size.z());
}

/// Assigns a TOML value to a member. Each overload returns the error, or an empty text.
class Reader {
 public:
  Reader(const Field& field, const toml::node& value, const Preset& preset,
         const FileContext& context, FileReport* report)
      : field_(field), value_(value), preset_(preset), context_(context), report_(report) {}

  /// Changes the member only if there is no error.
  template <class T>
  std::string operator()(T* member) {
    T fresh{};
    auto wrong = read(value_, fresh);
    if (wrong.empty()) *member = std::move(fresh);
    return wrong;
  }
  std::string operator()(const OneWord& word) {
    const auto index = index_of(value_, field_.words);
    if (!index) return value_.is_string() ? "unknown name" : type_text(value_);
    word.set(word.member, int(*index));
    return "";
  }
  std::string operator()(const SomeWords& words) {
    const auto* list = value_.as_array();
    if (!list) return type_text(value_);
    std::vector<int> indices;
    for (const auto& item : *list) {
      const auto index = index_of(item, field_.words);
      if (!index) return item.is_string() ? "unknown name" : "a list with " + type_text(item);
      if (std::ranges::count(indices, int(*index)) > 0) return "a name twice";
      indices.push_back(int(*index));
    }
    words.set(words.member, indices);
    return "";
  }
  /// Whether the error is a complete sentence, as those of files are, without "expected ..." to
  /// add.
  bool reported_in_full() const { return reported_in_full_; }

  /// Hint for a user who gave the name of a drawing as the points or the kind of a boundary.
  std::string drawing_hint(const std::string& name) const {
    const bool boundary = field_.key == "boundary" || field_.key == "points_mm";
    const auto dot = name.rfind('.');
    const std::string ending = dot == std::string::npos ? "" : name.substr(dot);
    return boundary && (ending == ".dxf" || ending == ".svg" || ending == ".obj")
               ? fmt::format("; an outline is drawn in file = \"{}\" with boundary = \"file\"",
                             name)
               : "";
  }

 private:
  std::string read(const toml::node& value, double& number) const {
    const auto real = real_of(value);
    if (!real) return kind_ + type_text(value);
    if (!field_.range.contains(*real)) return "out of range";
    number = *real;
    return magnitude_error(*real);
  }
  std::string read(const toml::node& value, int& number) const {
    const auto* integer = value.as_integer();
    if (!integer) return kind_ + type_text(value);
    if (!field_.range.contains(double(integer->get()))) return "out of range";
    number = int(integer->get());
    return "";
  }
  std::string read(const toml::node& value, bool& flag) const {
    if (!value.is_boolean()) return kind_ + type_text(value);
    flag = value.as_boolean()->get();
    return "";
  }
  std::string read(const toml::node& value, std::string& text) const {
    if (!value.is_string()) return kind_ + type_text(value);
    text = value.as_string()->get();
    const bool hex = text.size() == 7 && text[0] == '#' &&
                     text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    return field_.colour && !hex && !text.empty() && text != "transparent" ? "no colour" : "";
  }
  template <class Number>
  std::string read(const toml::node& value, std::optional<Number>& number) const {
    if (const auto* text = value.as_string(); text && text->get() == "none") {
      number.reset();
      return "";
    }
    return read(value, number.emplace());
  }
  template <class T>
  std::string read(const toml::node& value, std::vector<T>& list) {
    const auto* items = value.as_array();
    if (!items) return kind_ + type_text(value);
    kind_ = "a list with ";
    for (const auto& item : *items)
      if (auto wrong = read(item, list.emplace_back()); !wrong.empty()) return wrong;
    const auto size = std::size_t(1 + std::ranges::count(field_.shape, ','));
    const bool fits = field_.shape.empty() || list.empty() || list.size() == size;
    return fits ? "" : fmt::format("a list of {}", list.size());
  }
  std::string read(const toml::node& value, std::array<int, 2>& pair) {
    std::vector<int> numbers;
    if (auto wrong = read(value, numbers); !wrong.empty()) return wrong;
    if (numbers.size() != 2) return fmt::format("a list of {}", numbers.size());
    std::ranges::copy(numbers, pair.begin());
    return "";
  }
  // a table is read by read_axes(), where the positions of its errors are known
  std::string read(const toml::node& value, std::vector<SweepAxis>&) { return type_text(value); }

  std::string read(const toml::node& value, Points& points) {
    if (const auto* name = value.as_string(); name && !name->get().empty()) {
      const auto read_rows = [&](std::string_view bytes, const std::string& file) {
        return points_in(bytes, file, field_.coordinates, field_.coordinate_words);
      };
      if (auto wrong = read_file_of(name->get(), read_rows, largest_text, points); !wrong.empty())
        return wrong + drawing_hint(name->get());
      report(name->get(),
             fmt::format("{} points: {}", points.size(), fmt::join(field_.coordinates, ", ")));
      const auto wrong = points_error(points);
      reported_in_full_ = !wrong.empty();
      return reported_in_full_ ? (context_.folder / name->get()).string() + ": " + wrong : wrong;
    }
    const auto* list = value.as_array();
    if (!list) return type_text(value);
    for (const auto& item : *list) {
      const auto* point = item.as_array();
      if (!point) return "a list with " + type_text(item);
      if (point->size() != field_.coordinates.size())
        return fmt::format("a point of {} coordinates", point->size());
      auto& numbers = points.emplace_back();
      for (const auto& number : *point) {
        const auto words = field_.words_of(numbers.size());
        const auto real = words.empty() ? real_of(number) : index_of(number, words);
        if (!real) return "a point with " + type_text(number);
        numbers.push_back(*real);
      }
    }
    return points_error(points);
  }
  std::string read(const toml::node& value, SurfaceData& surface) {
    if (const auto* name = value.as_string()) {
      const double unit = millimetres(preset_.net.file_unit);
      const auto read = [&](std::string_view bytes,
                            const std::string& file) -> Result<SurfaceData> {
        SurfaceData& known = (*context_.surfaces)[{file, unit}];
        if (known.empty()) {
          TRY(found, read_surface(bytes, file, unit > 0 ? unit : 1));
          known = std::move(*found);
        }
        return known;
      };
      auto wrong = read_file_of(name->get(), read, largest_mesh_file, surface);
      if (!wrong.empty() || surface.empty()) return wrong;
      const auto notes = surface.is_mesh()
                             ? make_likely(surface, preset_.footprint.spacing_mm, unit > 0)
                             : std::vector<std::string>();
      if (report_) report_->notes.insert(report_->notes.end(), notes.begin(), notes.end());
      report(name->get(), surface_text(surface) + (unit > 0 ? ", unit by file_unit" : ""));
      return wrong;
    }
    if (!value.is_table()) return type_text(value);
    const auto wrong = read_parts(*value.as_table(), surface);
    return wrong.empty() ? surface_error(surface) : wrong;
  }
  std::string read(const toml::node& value, NetworkData& network) {
    if (const auto* name = value.as_string()) {
      const Footprint& of = preset_.footprint;
      const Rod& rod = preset_.rod;
      const NetworkOptions options{millimetres(of.file_unit), of.join_mm,
                                   rod.rectangular() ? rod.thickness_mm : rod.diameter_mm,
                                   of.linkage};
      const bool rods = of.kind == FootprintKind::network;
      const auto read = [&](std::string_view bytes, const std::string& file) {
        return rods ? read_network(bytes, file, options, report_)
                    : read_outline(bytes, file, options, report_);
      };
      return read_file_of(name->get(), read, largest_network_file, network);
    }
    if (!value.is_table()) return type_text(value);
    const auto wrong = read_parts(*value.as_table(), network);
    return wrong.empty() ? network_error(network) : wrong;
  }

  /// Reports the value read, for `check`.
  void report(const std::string& name, const std::string& text) {
    if (report_) report_->text = fmt::format("{}: {}", (context_.folder / name).string(), text);
  }

  // reads points, a surface or a network from a file; an empty name gives none
  template <class Data>
  std::string read_file_of(const std::string& name, const auto& read_data, std::size_t largest,
                           Data& data) {
    if (name.empty()) return "";
    const bool known = context_.built_in && context_.built_in->contains(name);
    const auto file = context_.folder / name;
    Result<Data> found = known ? read_data(context_.built_in->at(name), name)
                               : read_file(file, largest).and_then([&](const std::string& bytes) {
                                   return read_data(bytes, file.string());
                                 });
    reported_in_full_ = !found;
    if (!found) return found.error().message;
    data = std::move(*found);
    return "";
  }

  const Field& field_;
  const toml::node& value_;
  const Preset& preset_;
  const FileContext& context_;
  FileReport* report_;
  const char* kind_ = "";  // text before the type of a wrong value: "a list with "
  bool reported_in_full_ = false;
};

}  // namespace

std::string assign(const Field& field, const toml::node& value, Preset& preset,
                   const FileContext& context, int item, FileReport* report) {
  Reader reader(field, value, preset, context, report);
  const auto wrong = std::visit(reader, field.in(preset, item));
  if (wrong.empty() || reader.reported_in_full() || wrong.find("expected ") != std::string::npos)
    return wrong;
  std::string text = wrong + ", expected " + allowed(field);
  if (field.as_word(preset) && value.is_string())
    text += did_you_mean(value.as_string()->get(), field.words) +
            reader.drawing_hint(value.as_string()->get());
  return text;
}

std::string toml_text(const toml::node& value) {
  std::ostringstream out;
  out << toml::toml_formatter{value, toml::format_flags::none};
  auto text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
}

}  // namespace gridshell::preset
