// Sheets of paper for the workshop: what to cut, and how it goes together.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/record/fabrication.h"
#include "render/canvas/canvas.h"
#include "render/canvas/plot.h"

namespace gridshell::render {

/// One column of a table: how wide, points; 0: what is left, its text broken into lines. Numbers
/// are at the right.
struct TableColumn {
  std::string title;  ///< marked text
  double width = 0;
  AlignX align = AlignX::right;
};

/// A line of a table; plain text. Red where `stands_out`.
struct TableRow {
  std::vector<std::string> cells;
  bool stands_out = false;
};

/// Sheets of A4 filled from the top, as one PDF: headings, text, tables, pictures and plots; what
/// does not fit is on the next sheet.
class Sheets {
 public:
  /// `title` is at the foot of every sheet, with its number, and in the PDF's data.
  explicit Sheets(std::string title) : title_(std::move(title)) {}

  /// The heading of the complete text, or of what follows.
  void heading(const std::string& plain_text, double size = 11);
  /// Plain text, broken into lines.
  void text(const std::string& plain_text);
  /// Its head is repeated on each sheet on which it continues.
  void table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows);
  /// What something is, and how much, two pairs a line.
  void values(const std::vector<std::pair<std::string, std::string>>& pairs);
  /// Side by side, together as wide as the sheet, of the first one's proportions.
  void pictures(const std::vector<Image>& images);
  void plot(const Plot& plot, double height = 190);
  /// What follows begins on a sheet of its own.
  void next_sheet();

  std::string pdf() const;

 private:
  /// What extends across the sheet and is not parted.
  struct Item {
    double height = 0;
    std::function<void(Canvas& canvas, double y)> draw;
    bool with_next = false;   ///< never the last on its sheet
    std::size_t head = none;  ///< the item that comes before it at the top of a sheet
  };
  static constexpr std::size_t none = std::size_t(-1);
  static constexpr double break_here = 1e9;  ///< height of what ends a sheet

  void add(Item item) { items_.push_back(std::move(item)); }
  std::vector<std::vector<std::size_t>> laid_out() const;

  std::string title_;
  std::vector<Item> items_;
};

/// Rods of one length and with the same marks, from either end, in one row with their number;
/// `cut_list_text`: its cells.
std::string cut_list_text(const exports::FabricationPlan& work);
void add_cut_list(Sheets& sheets, const exports::FabricationPlan& work);
/// Writes the sheets as a PDF.
std::string cut_list_pdf(const exports::FabricationPlan& work);

/// One page of A4: the footprint and the plate in small, what is needed, the steps, and the legs
/// that are too short to build.
std::string assembly_sheet_pdf(const exports::FabricationPlan& work);

}  // namespace gridshell::render
