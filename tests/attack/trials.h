// Random attacks: their number (few in the suite, any by a variable) and their seed.
#pragma once

#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/environment.h"

/// The parts of the text between " | ".
inline std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0, end = 0; end != text.npos; at = end + 3) {
    end = text.find(" | ", at);
    words.push_back(text.substr(at, end - at));
  }
  return words;
}

/// GRIDSHELL_TRIALS, or `few`.
inline int trials(int few) { return number_from("GRIDSHELL_TRIALS", few); }

/// Random numbers that depend only on the seed (GRIDSHELL_SEED, or 1) and the number of the trial,
/// so that a trial that fails can be repeated alone.
class Draw {
 public:
  explicit Draw(int trial) {
    std::seed_seq all{number_from("GRIDSHELL_SEED", 1), trial};
    random_.seed(all);
  }

  /// From 0 to n - 1.
  std::size_t below(std::size_t n) { return std::size_t(random_() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  /// From 0 to 1.
  double fraction() { return double(random_()) / double(std::mt19937_64::max()); }
  char byte() { return char(below(256)); }

  template <class T>
  const T& of(const std::vector<T>& all) {
    return all[below(all.size())];
  }
  /// Calls one of the functions; one that is listed twice is chosen twice as often.
  void one_of(std::initializer_list<std::function<void()>> ways) {
    ways.begin()[below(ways.size())]();
  }

 private:
  std::mt19937_64 random_;
};

/// Prints exit codes and their counts, if GRIDSHELL_TRIALS is set.
inline void print_codes(const std::map<int, int>& codes, const std::string& whose) {
  if (!std::getenv("GRIDSHELL_TRIALS")) return;
  std::printf("%s:", whose.c_str());
  for (const auto& [code, count] : codes) std::printf(" %d x %d", count, code);
  std::printf("\n");
}
