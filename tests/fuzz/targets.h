// Fuzz targets: each reads untrusted bytes, and must neither crash nor take much memory or time.
// Built in two forms: with libFuzzer (`cmake --preset fuzz`), and as tests that replay the corpus
// in tests/fuzz/corpus/<name>.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gridshell::fuzz {

/// A fuzz target, and its name in the corpus.
struct Target {
  const char* name;
  void (*read)(std::string_view bytes);
};

/// A preset; if the first line starts with "--set " the remaining line is applied to it. The result
/// must be readable from its own text.
void preset(std::string_view bytes);
/// A file of points.
void points(std::string_view bytes);
/// A surface in a file whose name is the first line; a mesh that is read is checked and fitted.
void surface(std::string_view bytes);
/// A network of rods in a file whose name is the first line; one that is read must pass its own
/// check, and is made a footprint if it can be.
void network(std::string_view bytes);
/// A cloud of points in a file whose name is the first line.
void cloud(std::string_view bytes);
/// summary.json
void summary(std::string_view bytes);
/// frames.journal, all of its frames
void journal(std::string_view bytes);
/// Changes of a trajectory.h5 object by object, which is then read. HDF5's own parser is not tested
/// here: the program reads damaged files in a process of their own.
void trajectory(std::string_view bytes);
/// states.csv, states.json, transitions.csv and barriers.csv of one folder, separated by lines of
/// =====.
void states(std::string_view bytes);
/// sweep.jsonl; lines without a checksum get theirs.
void sweep_log(std::string_view bytes);
/// A picture for `compare`.
void png(std::string_view bytes);

inline constexpr Target targets[] = {{"preset", preset},   {"points", points},
                                     {"surface", surface}, {"cloud", cloud},
                                     {"network", network}, {"summary", summary},
                                     {"journal", journal}, {"trajectory", trajectory},
                                     {"states", states},   {"sweep_log", sweep_log},
                                     {"png", png}};

/// Bytes as a file, in memory where the system has such files.
class InputFile {
 public:
  explicit InputFile(std::string_view bytes) {
    path_ = std::filesystem::is_directory("/dev/shm") ? "/dev/shm/gridshell-fuzz-XXXXXX"
                                                      : "/tmp/gridshell-fuzz-XXXXXX";
    const int descriptor = mkstemp(path_.data());
    if (descriptor == -1) throw std::runtime_error("cannot create " + path_);
    while (!bytes.empty()) {
      const ssize_t put = ::write(descriptor, bytes.data(), bytes.size());
      if (put <= 0) throw std::runtime_error("cannot write " + path_);
      bytes.remove_prefix(std::size_t(put));
    }
    ::close(descriptor);
  }
  ~InputFile() { ::unlink(path_.c_str()); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::filesystem::path path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace gridshell::fuzz
