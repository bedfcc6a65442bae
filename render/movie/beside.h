// Several runs of one preset beside one another in a frame, each from its own camera, under one
// colour bar: the cases of a movie.
#pragma once

#include <string>
#include <vector>

#include "render/draw/renderer.h"
#include "render/movie/movie_writer.h"

namespace gridshell::render {

/// A run of the movie and what stands above it (plain text).
struct BesideRun {
  const record::Trajectory* run = nullptr;
  std::string name;
};

/// Frames `folder`/frame_00000.png ...: frame k of every run, the last one where a run ended
/// earlier. Size, quality, camera and colours are the style's; colours share one scale. Errors:
/// as write_movie.
Result<MovieReport> write_beside(const std::vector<BesideRun>& runs, const MovieStyle& style,
                                 Renderer& renderer, const std::filesystem::path& folder,
                                 Watch& watch, const OnFrame& on_frame = {});

}  // namespace gridshell::render
