// Sheets of paper as PDF: the cut list and the assembly sheet for the workshop, and reports.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/record/fabrication.h"
#include "render/canvas/canvas.h"
#include "render/canvas/plot.h"

namespace gridshell::render {

struct TableColumn {
  std::string title;  ///< text with markup
  double width = 0;   ///< points; 0: the remaining width
  AlignX align =
      AlignX::right;  ///< at the left, or of the remaining width: text is broken into lines
};

/// A row of a table, in plain text; red if `highlighted`.
struct TableRow {
  std::vector<std::string> cells;
  bool highlighted = false;
};

/// A PDF of A4 sheets, filled from the top with headings, text, tables, pictures and plots. An item
/// that does not fit begins the next sheet.
class Sheets {
 public:
  /// `title` is at the foot of every sheet, with the sheet's number, and in the PDF's metadata.
  explicit Sheets(std::string title) : title_(std::move(title)) {}

  /// Adds a heading of `size` points; the next item is on the same sheet.
  void heading(const std::string& plain_text, double size = 11);
  /// Adds plain text, broken into lines.
  void text(const std::string& plain_text);
  /// Adds a table, whose head is repeated on each sheet on which it continues.
  void table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows);
  /// Adds pairs of a name and a value, two per line.
  void values(const std::vector<std::pair<std::string, std::string>>& pairs);
  /// Adds pictures side by side, together as wide as the sheet, all in the first one's proportions.
  void pictures(const std::vector<Image>& images);
  /// Adds a plot of `height` points.
  void plot(const Plot& plot, double height = 190);
  /// Begins the next sheet.
  void next_sheet();

  /// The sheets as the bytes of a PDF.
  std::string pdf() const;

 private:
  /// A piece across the sheet that is not divided.
  struct Item {
    double height = 0;  ///< points
    std::function<void(Canvas& canvas, double y)> draw;
    bool with_next = false;   ///< on the same sheet as the next item
    std::size_t head = none;  ///< the item that is repeated above it at the top of a sheet
  };
  static constexpr std::size_t none = std::size_t(-1);
  static constexpr double break_here = 1e9;  ///< height of an item that ends its sheet

  void add(Item item) { items_.push_back(std::move(item)); }
  std::vector<std::vector<std::size_t>> laid_out() const;

  std::string title_;
  std::vector<Item> items_;
};

// A cut list has one row for all rods of one section and length with the same marks, from either
// end: their number, names, section, length and marks.

/// The rows of the cut list as text, one per line.
std::string cut_list_text(const exports::FabricationPlan& work);
void add_cut_list(Sheets& sheets, const exports::FabricationPlan& work);
std::string cut_list_pdf(const exports::FabricationPlan& work);

/// The assembly sheet as the bytes of a PDF of A4 pages: small drawings of the footprint and the
/// plate, the steps, and the legs that are too short to build.
std::string assembly_sheet_pdf(const exports::FabricationPlan& work);

}  // namespace gridshell::render
