// Between the renderer's pixels (RGBA, not premultiplied) and Cairo's (premultiplied, in the
// machine's byte order: BGRA on the little-endian machines this runs on).
#pragma once

#include <cstdint>

namespace gridshell::render {

void premultiply(const std::uint8_t* rgba, unsigned char* bgra, int pixels);
void unpremultiply(const unsigned char* bgra, std::uint8_t* rgba, int pixels);

}  // namespace gridshell::render
