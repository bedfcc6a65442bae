// PNG files to pictures and back.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "render/image/image.h"

namespace gridshell::render {

/// The picture as the bytes of an 8-bit PNG: RGB when every pixel is opaque, else RGBA. As fast as
/// keeps rendered frames small.
/// Errors: Fault::bad_input for an empty picture.
/// `dpi` above 0 is written into the file: pixels an inch as printed.
Result<std::string> encode_png(const Image& image, double dpi = 0);

/// Writes a PNG that is whole or absent. Errors: Fault::io naming the path and what the system
/// said; those of encode_png.
Result<void> write_png(const Image& image, const std::filesystem::path& path, double dpi = 0);

/// The picture in the bytes of a PNG of any colour type and bit depth, as 8-bit RGBA. Errors:
/// Fault::bad_input, with `name`, when it is no PNG or is damaged.
Result<Image> decode_png(std::string_view bytes, const std::string& name);

/// The same of a file. Errors: Fault::io naming the path and why it cannot be opened;
/// Fault::bad_input as above.
Result<Image> read_png(const std::filesystem::path& path);

}  // namespace gridshell::render
