#include "engine/formats/drawing.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>

#include "engine/core/text.h"

namespace gridshell::exports {
namespace {

// ----------------------------------------------------------------------------------------- DXF --

/// Writes DXF: pairs of a group code and its value, each on a line of its own.
class Dxf {
 public:
  void text(int code, const std::string& value) {
    fmt::format_to(std::back_inserter(text_), "{:>3}\n{}\n", code, value);
  }
  void integer(int code, int value) { text(code, fmt::format("{}", value)); }
  void number(int code, double value) { text(code, fmt::format("{:.9f}", value)); }
  void point(const Eigen::Vector3d& at, int shift = 0) {
    for (int k = 0; k < 3; ++k) number(10 * (k + 1) + shift, at[k]);
  }
  void begin_section(const char* name) {
    text(0, "SECTION");
    text(2, name);
  }
  void end_section() { text(0, "ENDSEC"); }
  std::string whole() && { return std::move(text_); }

 private:
  std::string text_;
};

void put_layers(Dxf& dxf, const std::vector<Layer>& layers) {
  dxf.begin_section("TABLES");
  dxf.text(0, "TABLE");
  dxf.text(2, "LAYER");
  dxf.integer(70, int(layers.size()));
  for (const Layer& layer : layers) {
    dxf.text(0, "LAYER");
    dxf.text(2, layer.name);
    dxf.integer(70, 0);
    dxf.integer(62, layer.colour);
    dxf.text(6, "CONTINUOUS");
  }
  dxf.text(0, "ENDTAB");
  dxf.end_section();
}

void put_line(Dxf& dxf, const DrawnLine& line, const std::string& layer) {
  if (line.points.size() == 2 && !line.closed) {
    dxf.text(0, "LINE");
    dxf.text(8, layer);
    dxf.point(line.points[0]);
    dxf.point(line.points[1], 1);
    return;
  }
  const auto is_flat = [](const Eigen::Vector3d& p) { return p.z() == 0; };
  const bool flat = std::ranges::all_of(line.points, is_flat);
  dxf.text(0, "POLYLINE");
  dxf.text(8, layer);
  dxf.integer(66, 1);
  dxf.point(Eigen::Vector3d::Zero());
  dxf.integer(70, (line.closed ? 1 : 0) + (flat ? 0 : 8));
  for (const Eigen::Vector3d& point : line.points) {
    dxf.text(0, "VERTEX");
    dxf.text(8, layer);
    dxf.point(point);
    dxf.integer(70, flat ? 0 : 32);
  }
  dxf.text(0, "SEQEND");
  dxf.text(8, layer);
}

void put_circle(Dxf& dxf, const DrawnCircle& circle, const std::string& layer) {
  dxf.text(0, "CIRCLE");
  dxf.text(8, layer);
  dxf.point({circle.centre.x(), circle.centre.y(), 0});
  dxf.number(40, circle.radius_mm);
}

void put_text(Dxf& dxf, const DrawnText& text, const std::string& layer) {
  dxf.text(0, "TEXT");
  dxf.text(8, layer);
  const Eigen::Vector3d at(text.at.x(), text.at.y(), 0);
  dxf.point(at);
  dxf.number(40, text.height_mm);
  dxf.text(1, text.text);
  dxf.integer(72, 1);  // about its middle
  dxf.integer(73, 2);
  dxf.point(at, 1);
}

// ----------------------------------------------------------------------------------------- SVG --

Eigen::AlignedBox2d box_of(const Drawing& drawing) {
  Eigen::AlignedBox2d box;
  for (const Layer& layer : drawing.layers) {
    for (const DrawnLine& line : layer.lines)
      for (const Eigen::Vector3d& point : line.points) box.extend(Eigen::Vector2d(point.head<2>()));
    for (const DrawnCircle& circle : layer.circles) {
      const Eigen::Vector2d half = Eigen::Vector2d::Constant(circle.radius_mm);
      box.extend(Eigen::Vector2d(circle.centre + half));
      box.extend(Eigen::Vector2d(circle.centre - half));
    }
    for (const DrawnText& text : layer.texts) {
      // a letter is at most about as wide as it is high
      const Eigen::Vector2d half(0.5 * text.height_mm * double(text.text.size()), text.height_mm);
      box.extend(Eigen::Vector2d(text.at + half));
      box.extend(Eigen::Vector2d(text.at - half));
    }
  }
  if (box.isEmpty()) box.extend(Eigen::Vector2d(0, 0));
  return box;
}

const char* web_colour(int colour) {
  return colour == 1 ? "#d00000" : colour == 3 ? "#008000" : colour == 5 ? "#0000d0" : "#000000";
}

}  // namespace

std::string to_dxf(const Drawing& drawing) {
  Dxf dxf;
  dxf.begin_section("HEADER");
  dxf.text(9, "$ACADVER");
  dxf.text(1, "AC1009");
  dxf.text(9, "$INSUNITS");
  dxf.integer(70, 4);
  dxf.end_section();
  put_layers(dxf, drawing.layers);
  dxf.begin_section("ENTITIES");
  for (const Layer& layer : drawing.layers) {
    for (const DrawnLine& line : layer.lines) put_line(dxf, line, layer.name);
    for (const DrawnCircle& circle : layer.circles) put_circle(dxf, circle, layer.name);
    for (const DrawnText& text : layer.texts) put_text(dxf, text, layer.name);
  }
  dxf.end_section();
  dxf.text(0, "EOF");
  return std::move(dxf).whole();
}

std::string to_svg(const Drawing& drawing) {
  constexpr double margin_mm = 5;
  const Eigen::AlignedBox2d box = box_of(drawing);
  const Eigen::Vector2d corner(box.min().x() - margin_mm, -box.max().y() - margin_mm),
      size = box.sizes().array() + 2 * margin_mm;
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.6f}mm\" height=\"{1:.6f}mm\" "
      "viewBox=\"{2:.6f} {3:.6f} {0:.6f} {1:.6f}\">\n<title>{4}</title>\n",
      size.x(), size.y(), corner.x(), corner.y(), escape_xml(drawing.title));
  auto out = std::back_inserter(svg);
  for (const Layer& layer : drawing.layers) {
    const char* colour = web_colour(layer.colour);
    fmt::format_to(out, "<g id=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"0.1\">\n",
                   layer.name, colour);
    for (const DrawnLine& line : layer.lines) {
      svg += line.closed ? "<polygon points=\"" : "<polyline points=\"";
      for (std::size_t k = 0; k < line.points.size(); ++k)
        fmt::format_to(out, "{}{:.6f},{:.6f}", k ? " " : "", line.points[k].x(),
                       -line.points[k].y());
      svg += "\"/>\n";
    }
    for (const DrawnCircle& circle : layer.circles)
      fmt::format_to(out, "<circle cx=\"{:.6f}\" cy=\"{:.6f}\" r=\"{:.6f}\"/>\n", circle.centre.x(),
                     -circle.centre.y(), circle.radius_mm);
    for (const DrawnText& text : layer.texts)
      fmt::format_to(out,
                     "<text x=\"{:.6f}\" y=\"{:.6f}\" font-size=\"{:.6f}\" "
                     "font-family=\"sans-serif\" text-anchor=\"middle\" "
                     "dominant-baseline=\"central\" fill=\"{}\" stroke=\"none\">{}</text>\n",
                     text.at.x(), -text.at.y(), text.height_mm, colour, escape_xml(text.text));
    svg += "</g>\n";
  }
  return svg + "</svg>\n";
}

}  // namespace gridshell::exports
