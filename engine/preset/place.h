// Where the values of a preset came from, and what is wrong with them.
#pragma once

#include <string>
#include <vector>

namespace gridshell::preset {

/// What is laid over what.
enum class Layer { file, one_case, command_line };

/// Where a value came from: a place in a file, or an option of the command line.
struct Place {
  std::string source;
  unsigned line = 0, column = 0;
  Layer layer = Layer::file;

  std::string text() const;
};

/// All that is wrong with a file, gathered on the way.
class PlacedFaults {
 public:
  void add(const Place& place, std::string text) { faults_.push_back({place, std::move(text)}); }
  bool empty() const { return faults_.empty(); }

  /// A line each, in the order of the file and each once; those of the command line come last.
  std::string report() const;

 private:
  struct PlacedFault {
    Place place;
    std::string text;
  };
  std::vector<PlacedFault> faults_;
};

}  // namespace gridshell::preset
