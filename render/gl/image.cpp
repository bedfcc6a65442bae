#include "render/gl/image.h"

#include <libdeflate.h>
#include <png.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "engine/core/file_io.h"
#include "engine/core/try.h"

namespace gridshell::render {
namespace {

// libpng calls on_error(), which must not return: it stores the message and jumps to the setjmp()
struct Failure {
  char message[160] = "";
};

void on_error(png_structp png, png_const_charp message) {
  auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
  std::snprintf(failure->message, sizeof failure->message, "%s", message);
  png_longjmp(png, 1);
}

constexpr std::size_t largest_chunk = 8000000;  // bytes of a text or profile that is read

void on_warning(png_structp, png_const_charp) {}

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

void append_number(std::string& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += char(number >> shift & 0xff);
}

// a PNG is a signature and chunks: length, type, data and a checksum of these two
void append_chunk(std::string& bytes, std::string_view type, std::string_view data) {
  append_number(bytes, std::uint32_t(data.size()));
  const std::size_t begin = bytes.size();
  bytes.append(type).append(data);
  append_number(bytes, libdeflate_crc32(0, bytes.data() + begin, bytes.size() - begin));
}

std::string header(const Image& image, bool with_alpha) {
  std::string data;
  append_number(data, std::uint32_t(image.width));
  append_number(data, std::uint32_t(image.height));
  const int colour_type = with_alpha ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB;
  for (const int byte : {8, colour_type, 0, 0, PNG_INTERLACE_NONE}) data += char(byte);
  return data;
}

// pixels per metre along both axes
std::string density(double dpi) {
  std::string data;
  for (int axis = 0; axis < 2; ++axis) append_number(data, std::uint32_t(dpi / 0.0254 + 0.5));
  return data + char(PNG_RESOLUTION_METER);
}

// the rows of a PNG, each after the number of its filter: none, which compresses as well as others
template <int channels>
std::vector<std::uint8_t> rows_of(const Image& image) {
  const std::size_t width = std::size_t(image.width);
  std::vector<std::uint8_t> rows((channels * width + 1) * std::size_t(image.height));
  std::uint8_t* to = rows.data();
  for (int y = 0; y < image.height; ++y) {
    *to++ = PNG_FILTER_VALUE_NONE;
    const std::uint8_t* pixel = image.pixel(0, y);
    for (std::size_t x = 0; x < width; ++x, to += channels)
      std::copy_n(pixel + 4 * x, channels, to);
  }
  return rows;
}

struct Free {
  void operator()(libdeflate_compressor* it) const { libdeflate_free_compressor(it); }
};

// `image` and `rows` belong to the caller, so that a longjmp does not skip their destructors
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
  if (width * height > most_pixels) {
    std::snprintf(failure.message, sizeof failure.message,
                  "it has %zu x %zu pixels, more than the %zu million that are read", width, height,
                  most_pixels / 1000000);
    png_longjmp(png, 1);
  }
  // any PNG becomes 8-bit RGBA: palettes and grey are expanded, a missing alpha is opaque
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

std::uint8_t largest_channel_difference(const std::uint8_t* a, const std::uint8_t* b) {
  int largest = 0;
  for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(int(a[c]) - int(b[c])));
  return static_cast<std::uint8_t>(largest);
}

// 0, step, 2 step, ... and the last start at which a block still fits
std::vector<int> block_starts(int length, int block) {
  std::vector<int> starts;
  for (int start = 0; start + block < length; start += block_step) starts.push_back(start);
  starts.push_back(length - block);
  return starts;
}

void paint(Image& image, int x, int y, std::array<std::uint8_t, 3> rgb) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::uint8_t* p = image.pixel(x, y);
  std::copy(rgb.begin(), rgb.end(), p);
  p[3] = 255;
}

// draws a frame of `thickness` pixels around the block, outside, so that the block remains visible
void outline(Image& image, const Comparison& block, int thickness) {
  const int x0 = block.x - thickness, x1 = block.x + block.width + thickness;
  const int y0 = block.y - thickness, y1 = block.y + block.height + thickness;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (x < block.x || x >= block.x + block.width || y < block.y || y >= block.y + block.height)
        paint(image, x, y, {0, 90, 255});
}

}  // namespace

Result<std::string> encode_png(const Image& image, double dpi) {
  if (image.width < 1 || image.height < 1)
    return invalid("a picture of {} x {} pixels cannot be a PNG", image.width, image.height);
  if (std::size_t(image.width) * std::size_t(image.height) > most_pixels)
    return invalid("size of the picture: got {} x {} pixels, expected at most {} million",
                   image.width, image.height, most_pixels / 1000000);
  const bool with_alpha = !opaque(image);
  const std::vector<std::uint8_t> rows = with_alpha ? rows_of<4>(image) : rows_of<3>(image);
  // libdeflate takes a third of zlib's time for the same size
  const std::unique_ptr<libdeflate_compressor, Free> compressor(libdeflate_alloc_compressor(1));
  if (!compressor) return fail(Fault::io, "cannot encode a PNG: out of memory");
  const std::size_t room = libdeflate_zlib_compress_bound(compressor.get(), rows.size());
  // without initialisation, since few pictures need all of it
  const std::unique_ptr<char[]> packed(new char[room]);
  const std::size_t size =
      libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(), packed.get(), room);
  std::string bytes("\x89PNG\r\n\x1a\n");
  append_chunk(bytes, "IHDR", header(image, with_alpha));
  if (dpi > 0) append_chunk(bytes, "pHYs", density(dpi));
  append_chunk(bytes, "IDAT", {packed.get(), size});
  append_chunk(bytes, "IEND", {});
  return bytes;
}

Result<void> write_png(const Image& image, const std::filesystem::path& path, double dpi) {
  TRY(bytes, encode_png(image, dpi));
  return write_file(path, *bytes);
}

Result<Image> decode_png(std::string_view bytes, const std::string& name) {
  Image image;
  std::vector<png_bytep> rows;
  Failure failure;
  if (!decode_rows(bytes, image, rows, failure))
    return invalid("'{}' is not a readable PNG: {}", name, failure.message);
  return image;
}

Result<Image> read_png(const std::filesystem::path& path) {
  TRY(bytes, read_file(path));
  return decode_png(*bytes, path.string());
}

Result<Comparison> compare(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height)
    return invalid("pictures of different size cannot be compared: {} x {} and {} x {}", a.width,
                   a.height, b.width, b.height);
  if (a.width < 1 || a.height < 1) return invalid("empty pictures (0 x 0) cannot be compared");

  std::vector<std::uint8_t> difference(std::size_t(a.width) * a.height);
  for (std::size_t k = 0; k < difference.size(); ++k)
    difference[k] = largest_channel_difference(&a.rgba[4 * k], &b.rgba[4 * k]);

  Comparison worst{.width = std::min(block_size, a.width),
                   .height = std::min(block_size, a.height)};
  int worst_sum = 0;
  for (int y : block_starts(a.height, worst.height))
    for (int x : block_starts(a.width, worst.width)) {
      int sum = 0;
      for (int row = 0; row < worst.height; ++row)
        for (int column = 0; column < worst.width; ++column)
          sum += difference[std::size_t(y + row) * a.width + x + column];
      if (sum <= worst_sum) continue;
      worst_sum = sum;
      worst.x = x;
      worst.y = y;
    }
  worst.difference = double(worst_sum) / (worst.width * worst.height);
  return worst;
}

Image difference_picture(const Image& a, const Image& b, const Comparison& worst, double gain) {
  Image picture(a.width, a.height);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::uint8_t* p = a.pixel(x, y);
      const double grey = 192 + 0.25 * (0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]);
      const double red = std::min(1.0, gain * largest_channel_difference(p, b.pixel(x, y)) / 255);
      const auto mix = [&](double from, double to) {
        return static_cast<std::uint8_t>(std::min(255.0, from + (to - from) * red + 0.5));
      };
      paint(picture, x, y, {mix(grey, 220), mix(grey, 0), mix(grey, 0)});
    }
  if (worst.difference > 0) outline(picture, worst, 2);
  return picture;
}

}  // namespace gridshell::render
