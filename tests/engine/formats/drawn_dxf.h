// Small DXF drawings for tests.
#pragma once

#include <string>

#include "engine/core/text.h"

namespace gridshell {

/// An entity by its codes and values, separated by blanks: entity("LINE", "10 0 20 0 11 9 21 0").
inline std::string entity(const std::string& kind, const std::string& groups) {
  std::string text = "0\n" + kind + "\n";
  for (const auto word : words_in(groups)) text.append(word).append("\n");
  return text;
}

inline std::string section(const std::string& name, const std::string& what) {
  return "0\nSECTION\n2\n" + name + "\n" + what + "0\nENDSEC\n";
}

/// A complete drawing, sections `before` its entities.
inline std::string drawn_dxf(const std::string& entities, const std::string& before = "") {
  return before + section("ENTITIES", entities) + "0\nEOF\n";
}

}  // namespace gridshell
