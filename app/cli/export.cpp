#include <fmt/format.h>
#include <functional>
#include <map>
#include <tuple>

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "app/cli/staged_folder.h"
#include "engine/core/file_io.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/fabrication_sheets.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

struct ExportOptions {
  std::string input;  ///< RUN; for anything but a shape also PRESET
  fs::path to;
  std::string what;       ///< shape, footprint ...; empty: the extension of `to` decides
  std::string frame;      ///< index of the frame; empty: the last
  std::string case_name;  ///< which of several cases
  double seconds = 6;     ///< duration of an animation
  bool no_checksum = false;
};

/// A run that is exported, and the requested frame.
struct Source {
  Run run;
  std::size_t frame = 0;
  fs::path folder;  ///< of the run

  exports::Shape shape(std::size_t k) const {
    const auto& [layout, frames] = std::tie(run.trajectory.layout, run.trajectory.frames);
    return {layout, frames[k], frames.front(), title()};
  }
  const std::string& title() const { return preset::title_or_name(run.preset); }
};

/// Writes the frames into the folder NAME_frames; returns the text of NAME.pvd, which lists them.
Result<std::string> write_series(const Source& source, const ExportOptions& options) {
  const fs::path& to = options.to;
  const fs::path name = to.stem().string() + "_frames", folder = to.parent_path() / name;
  TRY_DO(make_folder(folder));
  std::vector<double> progress;
  std::vector<std::string> files;
  const record::FrameList& frames = source.run.trajectory.frames;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const fs::path file = fmt::format("frame_{:05}.vtp", k);
    const exports::Shape shape = source.shape(k);
    TRY_DO(write_file(folder / file, exports::to_vtp(shape)));
    progress.push_back(shape.frame.progress);
    files.push_back((name / file).string());
  }
  return exports::to_pvd(progress, files);
}

Result<std::string> xdmf_of(const Source& source, const ExportOptions& options) {
  std::error_code error;
  const fs::path trajectory =
      fs::relative(source.folder / "trajectory.h5", fs::absolute(options.to).parent_path(), error);
  if (error || !fs::exists(source.folder / "trajectory.h5", error))
    return invalid("'{}' has no trajectory.h5, to which an .xdmf file refers",
                   source.folder.string());
  return exports::to_xdmf(source.run.trajectory.layout, source.run.trajectory.frames,
                          trajectory.string());
}

/// The requested case of several runs or presets.
template <class One>
Result<One> chosen(std::vector<One> cases, const ExportOptions& options) {
  std::string names;
  for (One& one : cases) {
    if (one.name == options.case_name) return std::move(one);
    names += (names.empty() ? "" : ", ") + one.name;
  }
  return invalid(
      names.empty() ? fmt::format("'{}' has no cases, so no '{}'", options.input, options.case_name)
                    : fmt::format("'{}' has several cases: choose one with --case: {}",
                                  options.input, names));
}

Result<std::size_t> frame_of(const record::Trajectory& run, const std::string& requested) {
  if (requested.empty()) return run.frames.size() - 1;
  const auto frame = parse_number<std::size_t>(requested);
  if (!frame || *frame >= run.frames.size())
    return invalid("--frame {}: expected a number from 0 to {}", requested, run.frames.size() - 1);
  return *frame;
}

Result<Source> source_of(const ExportOptions& options) {
  TRY(runs, read_runs(options.input, {}, options.no_checksum));
  TRY(run, chosen(std::move(*runs), options));
  TRY(frame, frame_of(run->trajectory, options.frame));
  const fs::path folder = folder_of(options.input, run->name);
  return Source{std::move(*run), *frame, folder};
}

/// The preset that is given, or that of the given run; of several cases the requested one.
Result<preset::Preset> preset_of(const ExportOptions& options) {
  TRY(presets, load_preset_or_run(options.input));
  return chosen(runs_of(*presets), options).map([](preset::Case&& one) {
    return std::move(one.preset);
  });
}

/// A function that makes the text of a file.
using TextOf = std::function<Result<std::string>(const ExportOptions&)>;

/// Text made from a run; `text` takes it and the options.
TextOf of_run(auto text) {
  return [text](const ExportOptions& options) -> Result<std::string> {
    TRY(source, source_of(options));
    Result<std::string> made = text(*source, options);
    if (const auto& fault = source->run.trajectory.frames.fault(); made && fault)
      return tl::unexpected(*fault);
    return made;
  };
}

/// Text made from the requested frame.
TextOf of_shape(auto text) {
  return of_run([text](const Source& source, const ExportOptions&) {
    return text(source.shape(source.frame));
  });
}

/// Text made from the fabrication plan, for which a preset is enough.
TextOf of_plan(auto text) {
  return [text](const ExportOptions& options) -> Result<std::string> {
    TRY(preset, preset_of(options));
    TRY(plan, simulate::fabrication_plan_of(*preset));
    return text(exports::rounded(std::move(*plan), preset->figure.cut_step_mm));
  };
}

/// Text made from the fabrication plan of a planar footprint.
TextOf of_flat(auto text) {
  return of_plan([text](const exports::FabricationPlan& plan) -> Result<std::string> {
    if (plan.in_space)
      return invalid(
          "a network that is drawn in space has no flat footprint; what can be exported is its cut "
          "list and its plate: --what cutlist, plate");
    return text(plan);
  });
}

/// Contents of a file, and the programs that read it.
struct Format {
  TextOf text;
  const char* read_by;
};
using FormatsByEnding = std::map<std::string, Format>;

/// What can be exported, by its name and by the extension of the file.
const std::vector<std::pair<std::string, FormatsByEnding>>& formats() {
  using exports::FabricationPlan;
  const auto drawn = [](auto to) {
    return of_flat(
        [to](const FabricationPlan& plan) { return to(exports::footprint_drawing(plan)); });
  };
  const auto plate = [](auto to) {
    return of_plan(
        [to](const FabricationPlan& plan) { return exports::plate_drawing(plan).map(to); });
  };
  constexpr const char *tables = "spreadsheets", *cutter = "laser cutter", *print = "workshop";
  static const std::vector<std::pair<std::string, FormatsByEnding>> all{
      {"shape",
       {{".csv", {of_shape(exports::to_csv), tables}},
        {".dxf",
         {of_shape([](const exports::Shape& shape) {
            return exports::to_dxf(exports::rods_in_space(shape));
          }),
          "Rhino, AutoCAD"}},
        {".glb",
         {of_run([](const Source& source, const ExportOptions& options) {
            return exports::to_glb(source.run.trajectory, source.title(), options.seconds);
          }),
          "Blender, slides"}},
        {".html",
         {of_run([](const Source& source, const ExportOptions&) {
            return exports::to_page(source.run.trajectory, source.title());
          }),
          "any browser"}},
        {".obj", {of_shape(exports::to_obj), "Blender, Rhino"}},
        {".pvd", {of_run(write_series), "ParaView, all frames"}},
        {".vtp", {of_shape(exports::to_vtp), "ParaView"}},
        {".xdmf", {of_run(xdmf_of), "ParaView, all frames"}}}},
      {"tubes", {{".obj", {of_shape(exports::to_obj_tubes), "Blender, Rhino"}}}},
      {"cutlist",
       {{".csv", {of_plan(exports::cut_list_csv), tables}},
        {".pdf", {of_plan(render::cut_list_pdf), print}}}},
      {"footprint",
       {{".dxf", {drawn(exports::to_dxf), cutter}}, {".svg", {drawn(exports::to_svg), cutter}}}},
      {"plate",
       {{".csv", {of_plan(exports::pins_csv), tables}},
        {".dxf", {plate(exports::to_dxf), cutter}},
        {".svg", {plate(exports::to_svg), cutter}}}},
      {"sheet", {{".pdf", {of_flat(render::assembly_sheet_pdf), print}}}}};
  return all;
}

/// What is exported to a file with this extension if --what is not given.
std::string usual_thing(const std::string& extension) {
  return extension == ".svg" ? "footprint" : extension == ".pdf" ? "sheet" : "shape";
}

std::string extensions_of(const FormatsByEnding& texts) {
  std::string list;
  for (const auto& [extension, text] : texts) list += (list.empty() ? "" : " ") + extension;
  return list;
}

/// A line for each thing that can be exported: "  shape      .csv .dxf ...".
std::string exported_formats() {
  std::string text;
  for (const auto& [what, texts] : formats())
    text += fmt::format("  {:<10} {}\n", what, extensions_of(texts));
  return text;
}

Result<std::string> text_of(const ExportOptions& options) {
  const std::string extension = options.to.extension().string();
  const std::string what = options.what.empty() ? usual_thing(extension) : options.what;
  for (const auto& [name, texts] : formats()) {
    if (name != what) continue;
    if (const auto text = texts.find(extension); text != texts.end())
      return text->second.text(options);
    return invalid("--to {}: --what {} is written as {}", options.to.string(), what,
                   extensions_of(texts));
  }
  return invalid("--what {}: expected one of\n{}", what, exported_formats());
}

/// Writes the file, complete or not at all, and prints its size.
Result<int> export_file(const ExportOptions& options) {
  TRY_DO(check_output_file(options.to));
  TRY(text, text_of(options));
  TRY_DO(write_with_folder(options.to, *text));
  fmt::print("{}: {} bytes\n", options.to.string(), text->size());
  return ExitCode::done;
}

}  // namespace

std::vector<ExportFormat> usual_exports() {
  std::vector<ExportFormat> usual;
  for (const auto& [what, by_ending] : formats())
    for (const auto& [ending, format] : by_ending)
      if (what == usual_thing(ending)) usual.push_back({ending, what, format.read_by});
  return usual;
}

// `gridshell export RUN --to FILE`: for other programs and for the workshop.

void add_export(CommandLine& program) {
  auto [command, options] = program.add<ExportOptions>(
      "export", "a run's shape for other programs, its footprint for the workshop", export_file);
  command.option("RUN", options.input, "folder of a run; for what is not a shape a PRESET too")
      .required();
  command.option("--to", options.to, "the file; its extension is the format").required();
  command.option("--what", options.what,
                 "shape, tubes, footprint, plate, cutlist or sheet; by default what the "
                 "extension is for");
  command.option("--frame", options.frame, "of a shape: index of its frame, by default the last");
  command.option("--case", options.case_name, "of several cases: which");
  command.option("--seconds", options.seconds, "of an animation (.glb)").in_range(0.1, 3600.0);
  add_no_checksum(command, options.no_checksum);
  command.footer("What is exported, and how:\n" + exported_formats());
}

}  // namespace gridshell::app
