#include "render/image/png.h"

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

#include "engine/core/atomic_file.h"

namespace gridshell::render {
namespace {

// libpng reports an error by a call that must not return; it is caught where setjmp was called
struct Failure {
  char message[160] = "";
};

void on_error(png_structp png, png_const_charp message) {
  auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
  std::snprintf(failure->message, sizeof failure->message, "%s", message);
  png_longjmp(png, 1);
}

// 16384 x 16384, the largest that is written, and a text or profile in it
constexpr std::size_t largest_pixels = std::size_t(1) << 28, largest_chunk = 8000000;

void on_warning(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

void flush(png_structp) {}

void take(png_structp png, png_bytep data, png_size_t size) {
  auto* bytes = static_cast<std::string_view*>(png_get_io_ptr(png));
  if (size > bytes->size()) png_error(png, "the file ends too early");
  std::copy_n(bytes->data(), size, reinterpret_cast<char*>(data));
  bytes->remove_prefix(size);
}

bool opaque(const Image& image) {
  for (std::size_t k = 3; k < image.rgba.size(); k += 4)
    if (image.rgba[k] != 255) return false;
  return true;
}

// everything with a destructor lives in the caller: a longjmp skips destructors
bool encode_rows(const Image& image, bool with_alpha, double dpi, png_bytep row, std::string& bytes,
                 Failure& failure) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &bytes, append, flush);
  png_set_IHDR(png, info, image.width, image.height, 8,
               with_alpha ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (dpi > 0) {
    const auto per_metre = png_uint_32(dpi / 0.0254 + 0.5);
    png_set_pHYs(png, info, per_metre, per_metre, PNG_RESOLUTION_METER);
  }
  // run lengths of the SUB filter's differences: a third less time than level 3, 8 % larger
  png_set_compression_level(png, 1);
  png_set_compression_strategy(png, Z_RLE);
  png_set_filter(png, 0, PNG_FILTER_SUB);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* pixel = image.pixel(0, y);
    const int channels = with_alpha ? 4 : 3;
    for (int x = 0; x < image.width; ++x) std::memcpy(row + channels * x, pixel + 4 * x, channels);
    png_write_row(png, row);
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

// `image` and `rows` are the caller's; a longjmp must not skip their destructors
bool decode_rows(std::string_view& bytes, Image& image, std::vector<png_bytep>& rows,
                 Failure& failure) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &bytes, take);
  png_set_chunk_malloc_max(png, largest_chunk);
  png_read_info(png, info);
  const std::size_t width = png_get_image_width(png, info),
                    height = png_get_image_height(png, info);
  if (width * height > largest_pixels) {
    std::snprintf(failure.message, sizeof failure.message,
                  "it has %zu x %zu pixels, more than the %zu million that are read", width, height,
                  largest_pixels / 1000000);
    png_longjmp(png, 1);
  }
  // palettes and grey to RGB, 1-4 bits up and 16 bits down to 8, no alpha to opaque
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  image = Image(static_cast<int>(png_get_image_width(png, info)),
                static_cast<int>(png_get_image_height(png, info)));
  rows.resize(image.height);
  for (int y = 0; y < image.height; ++y) rows[y] = image.pixel(0, y);
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

}  // namespace

Result<std::string> encode_png(const Image& image, double dpi) {
  if (image.width < 1 || image.height < 1)
    return fail(Fault::bad_input, fmt::format("a picture of {} x {} pixels cannot be a PNG",
                                              image.width, image.height));
  std::string bytes;
  std::vector<png_byte> row(std::size_t(4) * image.width);
  Failure failure;
  if (!encode_rows(image, !opaque(image), dpi, row.data(), bytes, failure))
    return fail(Fault::io, fmt::format("cannot encode a PNG: {}", failure.message));
  return bytes;
}

Result<void> write_png(const Image& image, const std::filesystem::path& path, double dpi) {
  auto bytes = encode_png(image, dpi);
  if (!bytes) return tl::unexpected(bytes.error());
  return write_atomically(path, *bytes);
}

Result<Image> read_png(const std::filesystem::path& path) {
  auto bytes = read_whole(path);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string_view left = *bytes;
  Image image;
  std::vector<png_bytep> rows;
  Failure failure;
  if (!decode_rows(left, image, rows, failure))
    return fail(Fault::bad_input,
                fmt::format("'{}' is not a readable PNG: {}", path.string(), failure.message));
  return image;
}

}  // namespace gridshell::render
