#include "engine/record/journal_records.h"

#include "engine/record/frame_columns.h"
#include "engine/record/layout_file.h"
#include "engine/record/packing.h"

namespace gridshell::record {
namespace {

template <class Visit>
void each_column(Visit visit) {
  for (const FrameColumn& column : frame_columns) visit(column);
  visit(actuation_column);
}

std::uint8_t kind_of(int) { return 0; }
std::uint8_t kind_of(double) { return 1; }
std::uint8_t kind_of(const std::string&) { return 2; }

void skip(Unpacker& in, std::uint8_t kind) {
  if (kind == kind_of(0)) in.number<std::int32_t>();
  if (kind == kind_of(0.0)) in.number<double>();
  if (kind == kind_of(std::string())) in.text();
}

}  // namespace

std::string packed_head(const RunName& name, const Layout& layout) {
  Packer out;
  out.text(name.preset);
  out.put(int(name.kind));
  std::vector<std::string> names;
  each_column([&](const FrameColumn& column) { names.push_back(column.name); });
  out.number(std::uint64_t(names.size()));
  for (const auto& name : names) out.text(name);
  out.text(image_of(layout));
  return out.bytes();
}

std::optional<JournalHead> unpacked_head(std::string_view bytes) {
  Unpacker in(bytes);
  JournalHead found;
  found.name.preset = in.text();
  const int kind = in.number<std::int32_t>();
  if (kind >= 0 && kind < int(words(Kind{}).size())) found.name.kind = static_cast<Kind>(kind);
  const auto count = in.number<std::uint64_t>();
  for (std::uint64_t k = 0; k < count && in.good(); ++k) found.columns.push_back(in.text());
  found.layout = in.text();
  if (!in.at_end()) return std::nullopt;
  return found;
}

std::string packed_frame(const Frame& frame) {
  Packer out;
  out.put(frame.index);
  each_column([&](const FrameColumn& column) {
    // its kind goes with a value, for whoever does not know the column
    visit_column(column, frame, [&](const auto& value) {
      out.number(kind_of(value));
      out.put(value);
    });
  });
  out.matrix(frame.nodes);
  out.matrix(frame.cell_K);
  out.matrix(frame.K_bins);
  out.matrix(frame.axial_force_N);
  out.matrix(frame.curvature_per_mm);
  out.matrix(frame.reactions_N);
  out.matrix(frame.bending_mJ_per_m);
  return out.bytes();
}

Result<Frame> unpacked_frame(std::string_view bytes, const std::vector<std::string>& columns) {
  Unpacker in(bytes);
  Frame frame;
  in.get(frame.index);
  for (const auto& name : columns) {
    const auto kind = in.number<std::uint8_t>();
    bool taken = false;
    each_column([&](const FrameColumn& column) {
      if (taken || name != column.name) return;
      visit_column(column, frame, [&](auto& value) {
        if (kind != kind_of(value)) return;
        taken = true;
        in.get(value);
      });
    });
    if (!taken) skip(in, kind);
  }
  in.matrix(frame.nodes, 3);
  in.matrix(frame.cell_K);
  in.matrix(frame.K_bins);
  // older versions ended here, or before the energies
  if (!in.at_end()) {
    in.matrix(frame.axial_force_N);
    in.matrix(frame.curvature_per_mm);
    in.matrix(frame.reactions_N, 3);
  }
  if (!in.at_end()) in.matrix(frame.bending_mJ_per_m);
  if (!in.at_end()) return fail(Fault::bad_input, "a frame is damaged");
  return frame;
}

}  // namespace gridshell::record
