// What a bench measures: lines for a reader, or with --json an object for tests/bench/compare.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gridshell {

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

  /// The other arguments.
  const std::vector<std::string>& words() const { return words_; }
  std::FILE* lines() const { return json_ ? stderr : stdout; }
  void add(const std::string& name, double value) { figures_[name] = value; }

 private:
  bool json_ = false;
  std::vector<std::string> words_;
  nlohmann::ordered_json figures_ = nlohmann::ordered_json::object();
};

}  // namespace gridshell
