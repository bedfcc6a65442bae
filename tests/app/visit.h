// Recordings that are played on a small shell, and what the program reports at their end.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/bench.h"

using nlohmann::json;

inline const std::string shell =
    small_preset({.rods = 6, .radius_mm = 66, .actuated_mm = 54, .edges = 0, .frames = 2});

/// Plays a recording on a small shell; returns the report that the program prints at its end.
inline json played(const TemporaryFolder& folder, const std::string& input,
                   const std::vector<std::string>& more = {}, const std::string& preset = shell) {
  REQUIRE(write_file(folder / "small.toml", preset));
  REQUIRE(write_file(folder / "visit.txt", input));
  std::vector<std::string> arguments{"view", "small.toml", "--play", "visit.txt"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ended ended = good(arguments, folder);
  return json::parse(ended.out);
}

// Lines of a recording: a click of the left button at a position, a drag over several positions,
// the key Enter, a text that is typed instead of that of a field (without Enter).
inline std::string click(const std::string& place) {
  return "mouse " + place + "\npress left\nrelease left\n";
}
inline std::string drag(const std::vector<std::string>& places) {
  std::string words = "mouse " + places[0] + "\npress left\n";
  for (std::size_t k = 1; k < places.size(); ++k) words += "mouse " + places[k] + "\n";
  return words + "release left\n";
}
inline const std::string enter = "down Enter\nup Enter\n";
inline std::string typed(const std::string& field, const std::string& text) {
  return "down Ctrl\n" + click(field + " 0.5 0.5") +
         "up Ctrl\ndown Ctrl\ndown A\nup A\nup Ctrl\ntype " + text + "\n";
}

inline double number(const json& of, const char* key) { return of[key].get<double>(); }
inline std::string message_of(const json& of) { return of["message"].get<std::string>(); }
