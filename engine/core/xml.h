// Text as XML takes it.
#pragma once

#include <string>
#include <string_view>

namespace gridshell {

/// Without the signs that XML takes for itself, and without control characters.
inline std::string xml_text(std::string_view letters) {
  std::string xml;
  for (char c : letters) {
    const bool control = static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    if (c == '&')
      xml += "&amp;";
    else if (c == '<')
      xml += "&lt;";
    else if (c == '>')
      xml += "&gt;";
    else if (!control)
      xml += c;
  }
  return xml;
}

}  // namespace gridshell
