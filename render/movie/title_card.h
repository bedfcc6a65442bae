// What stands before a movie: its title and what it follows.
#pragma once

#include "render/image/image.h"
#include "render/movie/style.h"

namespace gridshell::render {

/// A card of the movie's size with its title and, where there is one, its source below. Long titles
/// are set in several lines, and smaller until they fit.
Image title_card(const MovieStyle& style);

}  // namespace gridshell::render
