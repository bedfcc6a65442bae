#include "app/exporting.h"

#include <fmt/format.h>

#include <charconv>
#include <functional>
#include <map>
#include <set>

#include "app/console.h"
#include "app/finished_run.h"
#include "app/loading.h"
#include "app/manifest.h"
#include "engine/core/atomic_file.h"
#include "engine/experiment/workpiece.h"
#include "engine/export/fabrication.h"
#include "engine/export/formats.h"
#include "engine/export/gltf.h"
#include "engine/export/page.h"
#include "render/sheet/workshop.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

/// What is exported, and the frame that is asked for.
struct Source {
  FinishedRun run;
  std::size_t frame = 0;
  fs::path folder;  ///< of the run

  exports::Shape shape() const {
    return {run.trajectory.layout, run.trajectory.frames[frame], run.trajectory.frames.front(),
            title()};
  }
  std::string title() const {
    return run.preset.title.empty() ? run.preset.name : run.preset.title;
  }
};

Result<void> written(const fs::path& to, Result<std::string> text) {
  if (!text) return tl::unexpected(text.error());
  return write_atomically(to, *text);
}

/// A .vtp a frame in the folder NAME_frames beside NAME.pvd.
Result<void> write_series(const Source& source, const fs::path& to) {
  const fs::path name = to.stem().string() + "_frames", folder = to.parent_path() / name;
  if (auto made = make_folder(folder); !made) return made;
  std::vector<double> progress;
  std::vector<std::string> files;
  const record::FrameList& frames = source.run.trajectory.frames;
  const record::Frame start = frames.front();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const fs::path file = fmt::format("frame_{:05}.vtp", k);
    const exports::Shape shape{source.run.trajectory.layout, frames[k], start, source.title()};
    if (auto put = write_atomically(folder / file, exports::to_vtp(shape)); !put) return put;
    progress.push_back(shape.frame.progress);
    files.push_back((name / file).string());
  }
  return write_atomically(to, exports::to_pvd(progress, files));
}

Result<void> write_xdmf(const Source& source, const fs::path& to) {
  std::error_code error;
  const fs::path trajectory =
      fs::relative(source.folder / "trajectory.h5", fs::absolute(to).parent_path(), error);
  if (error || !fs::exists(source.folder / "trajectory.h5", error))
    return fail(Fault::bad_input, fmt::format("'{}' has no trajectory.h5, which .xdmf speaks of",
                                              source.folder.string()));
  return write_atomically(to, exports::to_xdmf(source.run.trajectory.layout,
                                               source.run.trajectory.frames, trajectory.string()));
}

using WriteShape = std::function<Result<void>(const Source&, const ExportOptions&)>;
using WriteWork = std::function<Result<void>(const exports::Workpiece&, const fs::path& to)>;

template <class Text>
WriteShape one_frame(Text text) {
  return [text](const Source& source, const ExportOptions& options) {
    return write_atomically(options.to, text(source.shape()));
  };
}

/// The formats of a shape, by extension.
const std::map<std::string, WriteShape>& shape_formats() {
  static const std::map<std::string, WriteShape> formats{
      {".csv", one_frame(exports::to_csv)},
      {".dxf", one_frame([](const exports::Shape& shape) {
         return exports::to_dxf(exports::rods_in_space(shape));
       })},
      {".glb",
       [](const Source& source, const ExportOptions& options) {
         return written(options.to,
                        exports::to_glb(source.run.trajectory, source.title(), options.seconds));
       }},
      {".html",
       [](const Source& source, const ExportOptions& options) {
         return written(options.to, exports::to_page(source.run.trajectory, source.title()));
       }},
      {".obj", one_frame(exports::to_obj)},
      {".pvd", [](const Source& source,
                  const ExportOptions& options) { return write_series(source, options.to); }},
      {".vtp", one_frame(exports::to_vtp)},
      {".xdmf", [](const Source& source, const ExportOptions& options) {
         return write_xdmf(source, options.to);
       }}};
  return formats;
}

Result<void> write_plate(const exports::Workpiece& work, const fs::path& to,
                         std::string (*text)(const exports::Drawing&)) {
  return exports::plate_drawing(work).and_then(
      [&](const exports::Drawing& drawing) { return write_atomically(to, text(drawing)); });
}

/// What is made for the workshop, and its formats by extension.
const std::map<std::string, std::map<std::string, WriteWork>>& workshop_formats() {
  using exports::Workpiece;
  static const std::map<std::string, std::map<std::string, WriteWork>> formats{
      {"footprint",
       {{".dxf",
         [](const Workpiece& work, const fs::path& to) {
           return write_atomically(to, exports::to_dxf(exports::footprint_drawing(work)));
         }},
        {".svg",
         [](const Workpiece& work, const fs::path& to) {
           return write_atomically(to, exports::to_svg(exports::footprint_drawing(work)));
         }}}},
      {"plate",
       {{".csv", [](const Workpiece& work,
                    const fs::path& to) { return write_atomically(to, exports::pins_csv(work)); }},
        {".dxf", [](const Workpiece& work,
                    const fs::path& to) { return write_plate(work, to, exports::to_dxf); }},
        {".svg", [](const Workpiece& work,
                    const fs::path& to) { return write_plate(work, to, exports::to_svg); }}}},
      {"cutlist",
       {{".csv",
         [](const Workpiece& work, const fs::path& to) {
           return write_atomically(to, exports::cut_list_csv(work));
         }},
        {".pdf",
         [](const Workpiece& work, const fs::path& to) {
           return write_atomically(to, render::cut_list_pdf(work));
         }}}},
      {"sheet", {{".pdf", [](const Workpiece& work, const fs::path& to) {
                    return write_atomically(to, render::assembly_sheet_pdf(work));
                  }}}}};
  return formats;
}

/// What an extension is for where --what does not say.
std::string usual_for(const std::string& extension) {
  if (extension == ".svg") return "footprint";
  if (extension == ".pdf") return "sheet";
  return "shape";
}

template <class Formats>
std::string extensions_of(const Formats& formats) {
  std::string list;
  for (const auto& [extension, write] : formats) list += (list.empty() ? "" : " ") + extension;
  return list;
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

/// Which of several runs.
Result<FinishedRun> one_of(std::vector<FinishedRun> runs, const ExportOptions& options) {
  std::string names;
  for (FinishedRun& run : runs) {
    if (run.name == options.case_name) return std::move(run);
    names += (names.empty() ? "" : ", ") + run.name;
  }
  if (runs.size() == 1 && runs.front().name.empty())
    return fail(Fault::bad_input,
                fmt::format("'{}' has no cases, so no '{}'", options.input, options.case_name));
  return fail(Fault::bad_input, fmt::format("'{}' holds several cases: choose one with --case: {}",
                                            options.input, names));
}

Result<std::size_t> frame_of(const record::Trajectory& run, const std::string& asked) {
  if (asked.empty()) return run.frames.size() - 1;
  std::size_t frame = 0;
  const auto read = std::from_chars(asked.data(), asked.data() + asked.size(), frame);
  if (read.ec != std::errc() || read.ptr != asked.data() + asked.size() ||
      frame >= run.frames.size())
    return fail(Fault::bad_input, fmt::format("--frame {}: must be a number from 0 to {}", asked,
                                              run.frames.size() - 1));
  return frame;
}

Result<Source> source_of(const ExportOptions& options) {
  auto runs = read_runs(options.input, {}, options.unsealed);
  if (!runs) return tl::unexpected(runs.error());
  auto run = one_of(std::move(*runs), options);
  if (!run) return tl::unexpected(run.error());
  const auto frame = frame_of(run->trajectory, options.frame);
  if (!frame) return tl::unexpected(frame.error());
  const fs::path folder = folder_of(options.input, run->name);
  return Source{std::move(*run), *frame, folder};
}

/// The preset of a run or by itself, of the case that is asked for.
Result<preset::Preset> preset_of(const ExportOptions& options) {
  if (is_folder(options.input)) {
    auto source = source_of(options);
    if (!source) return tl::unexpected(source.error());
    return std::move(source->run.preset);
  }
  Options plain;
  plain.input = options.input;
  const auto presets = load(plain);
  if (!presets) return tl::unexpected(presets.error());
  std::string names;
  for (const preset::Case& one : runs_of(*presets)) {
    if (one.name == options.case_name) return one.preset;
    names += (names.empty() ? "" : ", ") + one.name;
  }
  return fail(Fault::bad_input,
              names.empty()
                  ? fmt::format("'{}' has no cases, so no '{}'", options.input, options.case_name)
                  : fmt::format("'{}' has several cases: choose one with --case: {}", options.input,
                                names));
}

/// A file in a run's folder would be taken for one of the run, or keep it from being replaced.
Result<void> check_place(const fs::path& to) {
  std::error_code error;
  if (fs::exists(to, error) && !fs::is_regular_file(to, error))
    return fail(Fault::bad_input,
                fmt::format("'{}' is no file that could be written", to.string()));
  for (fs::path folder = fs::absolute(to, error).parent_path(); folder != folder.root_path();
       folder = folder.parent_path())
    if (fs::exists(folder / manifest_name, error))
      return fail(Fault::bad_input,
                  fmt::format("'{}' would lie in the run folder '{}'; choose a place beside it",
                              to.string(), folder.string()));
  const fs::path parent = to.parent_path();
  return parent.empty() ? Result<void>{} : make_folder(parent);
}

Result<void> write(const ExportOptions& options) {
  const std::string extension = options.to.extension().string();
  const std::string what = options.what.empty() ? usual_for(extension) : options.what;
  const auto no_format = [&](const std::string& has) {
    return fail(Fault::bad_input,
                fmt::format("--to {}: a {} is written as {}", options.to.string(), what, has));
  };
  if (auto place = check_place(options.to); !place) return place;
  if (what == "shape" || what == "tubes") {
    const auto& formats = shape_formats();
    const bool tubes = what == "tubes";
    if (tubes && extension != ".obj") return no_format(".obj");
    if (!formats.contains(extension)) return no_format(extensions_of(formats));
    auto source = source_of(options);
    if (!source) return tl::unexpected(source.error());
    auto done = tubes ? write_atomically(options.to, exports::to_obj_tubes(source->shape()))
                      : formats.at(extension)(*source, options);
    if (const auto& fault = source->run.trajectory.frames.fault(); done && fault)
      return tl::unexpected(*fault);
    return done;
  }
  const auto formats = workshop_formats().find(what);
  if (formats == workshop_formats().end())
    return fail(Fault::bad_input,
                fmt::format("--what {}: must be one of\n{}", what, exported_formats()));
  if (!formats->second.contains(extension)) return no_format(extensions_of(formats->second));
  const auto preset = preset_of(options);
  if (!preset) return tl::unexpected(preset.error());
  return experiment::workpiece_of(*preset).and_then([&](const exports::Workpiece& work) {
    return formats->second.at(extension)(work, options.to);
  });
}

}  // namespace

std::string exported_formats() {
  std::string text =
      fmt::format("  shape      {}\n  tubes      .obj\n", extensions_of(shape_formats()));
  for (const auto& [what, formats] : workshop_formats())
    text += fmt::format("  {:<10} {}\n", what, extensions_of(formats));
  return text;
}

int export_file(const ExportOptions& options) {
  if (auto done = write(options); !done) return report(done.error());
  std::error_code error;
  fmt::print("{}: {} bytes\n", options.to.string(), fs::file_size(options.to, error));
  return ExitCode::done;
}

}  // namespace gridshell::app
