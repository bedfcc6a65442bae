#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/finished_run.h"
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

/// What is exported, and the frame that is asked for.
struct Source {
  FinishedRun run;
  std::size_t frame = 0;
  fs::path folder;  ///< of the run

  exports::Shape shape() const {
    return {run.trajectory.layout, run.trajectory.frames[frame], run.trajectory.frames.front(),
            title()};
  }
  const std::string& title() const { return preset::title_or_name(run.preset); }
};

/// NAME.pvd, and its frames in the folder NAME_frames beside it, which are written.
Result<std::string> write_series(const Source& source, const fs::path& to) {
  const fs::path name = to.stem().string() + "_frames", folder = to.parent_path() / name;
  TRY_DO(make_folder(folder));
  std::vector<double> progress;
  std::vector<std::string> files;
  const record::FrameList& frames = source.run.trajectory.frames;
  const record::Frame start = frames.front();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const fs::path file = fmt::format("frame_{:05}.vtp", k);
    const exports::Shape shape{source.run.trajectory.layout, frames[k], start, source.title()};
    TRY_DO(write_file(folder / file, exports::to_vtp(shape)));
    progress.push_back(shape.frame.progress);
    files.push_back((name / file).string());
  }
  return exports::to_pvd(progress, files);
}

Result<std::string> xdmf_of(const Source& source, const fs::path& to) {
  std::error_code error;
  const fs::path trajectory =
      fs::relative(source.folder / "trajectory.h5", fs::absolute(to).parent_path(), error);
  if (error || !fs::exists(source.folder / "trajectory.h5", error))
    return fail(Fault::bad_input, fmt::format("'{}' has no trajectory.h5, which .xdmf speaks of",
                                              source.folder.string()));
  return exports::to_xdmf(source.run.trajectory.layout, source.run.trajectory.frames,
                          trajectory.string());
}

/// The text of a file, by the thing and by the extension.
template <class... Arguments>
using Formats =
    std::map<std::string,
             std::map<std::string, std::function<Result<std::string>(const Arguments&...)>>>;

/// Of what a run is needed for.
const Formats<Source, ExportOptions>& shape_formats() {
  const auto frame = [](auto text) {
    return [text](const Source& source, const ExportOptions&) -> Result<std::string> {
      return text(source.shape());
    };
  };
  static const Formats<Source, ExportOptions> formats{
      {"shape",
       {{".csv", frame(exports::to_csv)},
        {".dxf", frame([](const exports::Shape& shape) {
           return exports::to_dxf(exports::rods_in_space(shape));
         })},
        {".glb",
         [](const Source& source, const ExportOptions& options) {
           return exports::to_glb(source.run.trajectory, source.title(), options.seconds);
         }},
        {".html",
         [](const Source& source, const ExportOptions&) {
           return exports::to_page(source.run.trajectory, source.title());
         }},
        {".obj", frame(exports::to_obj)},
        {".pvd", [](const Source& source,
                    const ExportOptions& options) { return write_series(source, options.to); }},
        {".vtp", frame(exports::to_vtp)},
        {".xdmf", [](const Source& source,
                     const ExportOptions& options) { return xdmf_of(source, options.to); }}}},
      {"tubes", {{".obj", frame(exports::to_obj_tubes)}}}};
  return formats;
}

/// Of what is made for the workshop, for which a preset is enough.
const Formats<exports::FabricationPlan>& workshop_formats() {
  using exports::FabricationPlan;
  const auto flat = [](auto text) {
    return [text](const FabricationPlan& work) -> Result<std::string> {
      if (work.in_space)
        return fail(Fault::bad_input,
                    "a network that is drawn in space has no flat footprint to be cut from; its "
                    "cut list and the pins of its plate are there: --what cutlist, plate");
      return text(work);
    };
  };
  static const Formats<FabricationPlan> formats{
      {"footprint",
       {{".dxf", flat([](const FabricationPlan& work) {
           return exports::to_dxf(exports::footprint_drawing(work));
         })},
        {".svg", flat([](const FabricationPlan& work) {
           return exports::to_svg(exports::footprint_drawing(work));
         })}}},
      {"plate",
       {{".csv", exports::pins_csv},
        {".dxf",
         [](const FabricationPlan& work) {
           return exports::plate_drawing(work).map(exports::to_dxf);
         }},
        {".svg",
         [](const FabricationPlan& work) {
           return exports::plate_drawing(work).map(exports::to_svg);
         }}}},
      {"cutlist", {{".csv", exports::cut_list_csv}, {".pdf", render::cut_list_pdf}}},
      {"sheet", {{".pdf", flat(render::assembly_sheet_pdf)}}}};
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

/// Which of several runs or presets.
template <class One>
Result<One> chosen(std::vector<One> cases, const ExportOptions& options) {
  std::string names;
  for (One& one : cases) {
    if (one.name == options.case_name) return std::move(one);
    names += (names.empty() ? "" : ", ") + one.name;
  }
  return fail(Fault::bad_input,
              names.empty()
                  ? fmt::format("'{}' has no cases, so no '{}'", options.input, options.case_name)
                  : fmt::format("'{}' has several cases: choose one with --case: {}", options.input,
                                names));
}

Result<std::size_t> frame_of(const record::Trajectory& run, const std::string& asked) {
  if (asked.empty()) return run.frames.size() - 1;
  const auto frame = parse_number<std::size_t>(asked);
  if (!frame || *frame >= run.frames.size())
    return fail(Fault::bad_input, fmt::format("--frame {}: must be a number from 0 to {}", asked,
                                              run.frames.size() - 1));
  return *frame;
}

Result<Source> source_of(const ExportOptions& options) {
  TRY(runs, read_runs(options.input, {}, options.unsealed));
  TRY(run, chosen(std::move(*runs), options));
  TRY(frame, frame_of(run->trajectory, options.frame));
  const fs::path folder = folder_of(options.input, run->name);
  return Source{std::move(*run), *frame, folder};
}

/// The preset of a run or by itself, of the case that is asked for.
Result<preset::Preset> preset_of(const ExportOptions& options) {
  TRY(presets, load_preset_or_run(options.input));
  return chosen(runs_of(*presets), options).map([](preset::Case&& one) {
    return std::move(one.preset);
  });
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
  return {};
}

Result<std::string> shape_text(const ExportOptions& options, const auto& text_of) {
  TRY(source, source_of(options));
  auto text = text_of(*source, options);
  if (const auto& fault = source->run.trajectory.frames.fault(); text && fault)
    return tl::unexpected(*fault);
  return text;
}

Result<std::string> text_of(const ExportOptions& options) {
  const std::string extension = options.to.extension().string();
  const std::string what = options.what.empty() ? usual_for(extension) : options.what;
  const auto with = [&](const auto& formats, const auto& make) -> Result<std::string> {
    if (const auto format = formats.find(extension); format != formats.end())
      return make(format->second);
    return fail(Fault::bad_input, fmt::format("--to {}: a {} is written as {}", options.to.string(),
                                              what, extensions_of(formats)));
  };
  if (const auto shape = shape_formats().find(what); shape != shape_formats().end())
    return with(shape->second, [&](const auto& text) { return shape_text(options, text); });
  if (const auto work = workshop_formats().find(what); work != workshop_formats().end())
    return with(work->second, [&](const auto& text) {
      return preset_of(options).and_then(simulate::fabrication_plan_of).and_then(text);
    });
  return fail(Fault::bad_input,
              fmt::format("--what {}: must be one of\n{}", what, exported_formats()));
}

Result<void> write(const ExportOptions& options) {
  if (auto place = check_place(options.to); !place) return place;
  TRY(text, text_of(options));
  const fs::path parent = options.to.parent_path();
  return (parent.empty() ? Result<void>{} : make_folder(parent)).and_then([&] {
    return write_file(options.to, *text);
  });
}

}  // namespace

std::string exported_formats() {
  std::string text;
  const auto list = [&](const auto& things) {
    for (const auto& [what, formats] : things)
      text += fmt::format("  {:<10} {}\n", what, extensions_of(formats));
  };
  list(shape_formats());
  list(workshop_formats());
  return text;
}

int export_file(const ExportOptions& options) {
  if (auto done = write(options); !done) return report(done.error());
  std::error_code error;
  fmt::print("{}: {} bytes\n", options.to.string(), fs::file_size(options.to, error));
  return ExitCode::done;
}

// `gridshell export RUN --to FILE`: for other programs and for the workshop.

void add_export(CLI::App& program, Action& action) {
  const auto options = std::make_shared<ExportOptions>();
  auto* command = program.add_subcommand(
      "export", "a run's shape for other programs, its footprint for the workshop");
  command
      ->add_option("RUN", options->input, "folder of a run; for what is not a shape a PRESET too")
      ->required();
  command->add_option("--to", options->to, "the file; its extension is the format")->required();
  command->add_option("--what", options->what,
                      "shape, tubes, footprint, plate, cutlist or sheet; by default what the "
                      "extension is for");
  command->add_option("--frame", options->frame,
                      "of a shape: index of its frame, by default the last");
  command->add_option("--case", options->case_name, "of several cases: which");
  command->add_option("--seconds", options->seconds, "of an animation (.glb)")
      ->check(CLI::Range(0.1, 3600.0));
  command->add_flag("--unsealed", options->unsealed,
                    "take a trajectory.h5 that another program wrote or changed");
  command->footer("What is exported, and how:\n" + exported_formats());
  command->callback([&action, options] { action = [options] { return export_file(*options); }; });
}

}  // namespace gridshell::app
