// CPU time that a bench measures, and its output: lines for a reader, or with --json an object for
// tests/bench/compare.
#pragma once

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gridshell {

/// CPU time of all threads of this process, s.
inline double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}
inline double cpu_ms() { return 1e3 * cpu_now(); }

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Figures by name, the smaller the better. With --json among the arguments the lines go to stderr
/// and the figures to stdout, as {"name": number, ...}.
class Figures {
 public:
  Figures(int count, char** arguments) {
    words_.assign(arguments + 1, arguments + count);
    json_ = std::erase(words_, "--json") > 0;
  }
  ~Figures() {
    if (json_) std::puts(figures_.dump(1).c_str());
  }
  Figures(const Figures&) = delete;
  Figures& operator=(const Figures&) = delete;

  /// The arguments except --json.
  const std::vector<std::string>& words() const { return words_; }
  std::FILE* lines() const { return json_ ? stderr : stdout; }
  template <class... Values>
  void print(fmt::format_string<Values...> line, Values&&... values) const {
    fmt::print(lines(), line, std::forward<Values>(values)...);
  }
  /// Adds a figure and prints a line for it, with a remark.
  void report(const std::string& name, double value, const char* remark) {
    print("{:40} {:8.2f} ({})\n", name, value, remark);
    add(name, value);
  }
  void add(const std::string& name, double value) { figures_[name] = value; }

 private:
  bool json_ = false;
  std::vector<std::string> words_;
  nlohmann::ordered_json figures_ = nlohmann::ordered_json::object();
};

}  // namespace gridshell
