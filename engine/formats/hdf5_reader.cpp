#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>

#include "engine/core/file_io.h"
#include "engine/core/system_info.h"
#include "engine/formats/hdf5_file.h"

namespace gridshell::record::hdf5 {
namespace {

constexpr std::size_t longest_text = 65536;  // bytes of an attribute

bool stored_plainly(hid_t set) {
  const Handle how(H5Dget_create_plist(set), H5Pclose);
  const auto layout = H5Pget_layout(how);
  return (layout == H5D_CONTIGUOUS || layout == H5D_COMPACT) && H5Pget_external_count(how) == 0 &&
         H5Pget_nfilters(how) == 0;
}

// whether values of a type can be read as another: numbers as numbers, lists as lists, structs if
// all their members by name can
bool fits(hid_t found, hid_t requested) {
  const auto kind = H5Tget_class(found);
  if (kind != H5Tget_class(requested)) return false;
  if (kind == H5T_STRING) return H5Tis_variable_str(found) > 0;
  if (kind == H5T_VLEN || kind == H5T_ARRAY) {
    const Handle a(H5Tget_super(found), H5Tclose), b(H5Tget_super(requested), H5Tclose);
    hsize_t one = 0, other = 0;
    if (kind == H5T_ARRAY &&
        (H5Tget_array_ndims(found) != 1 || H5Tget_array_ndims(requested) != 1 ||
         H5Tget_array_dims2(found, &one) < 0 || H5Tget_array_dims2(requested, &other) < 0))
      return false;
    return one == other && fits(a, b);
  }
  if (kind != H5T_COMPOUND) return H5Tget_size(found) <= 16;
  const int members = H5Tget_nmembers(requested);
  if (H5Tget_nmembers(found) != members) return false;
  for (int k = 0; k < members; ++k) {
    char* name = H5Tget_member_name(requested, unsigned(k));
    const int at = H5Tget_member_index(found, name);
    H5free_memory(name);
    if (at < 0) return false;
    const Handle a(H5Tget_member_type(found, unsigned(at)), H5Tclose),
        b(H5Tget_member_type(requested, unsigned(k)), H5Tclose);
    if (!fits(a, b)) return false;
  }
  return true;
}

}  // namespace

Reader::Reader(std::string_view bytes) : file_bytes_(bytes.size()) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 65536, false);
  H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size());
  // no file is opened by this name, but the library takes open files of equal names for the same
  const std::string name = fmt::format("image {}", static_cast<const void*>(this));
  file_ = Handle(H5Fopen(name.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  check(file_, "file");
}

Reader::Reader(const std::filesystem::path& file) {
  std::error_code error;
  file_bytes_ = std::filesystem::file_size(file, error);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // no lock: nobody writes to the file, and not every file system has locks
  H5Pset_file_locking(access, false, true);
  file_ = Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  check(error ? hid_t(-1) : hid_t(file_), "file");
}

bool Reader::linked(const std::string& name) {
  if (name == "/") return true;
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end);
    H5L_info_t about{};
    if (H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0 ||
        H5Lget_info(file_, part.c_str(), &about, H5P_DEFAULT) < 0 || about.type != H5L_TYPE_HARD)
      return false;
    if (end == std::string::npos) return true;
  }
}

bool Reader::has(const std::string& name) { return good() && linked(name); }

Handle Reader::dataset(const std::string& name, hid_t type) {
  if (!good()) return {};
  const auto refuse = [&](const char* because) {
    fail_because(fmt::format("{} {}", name, because));
    return Handle();
  };
  if (!linked(name)) return refuse("is missing, or a link");
  Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!check(set, name)) return {};
  if (!stored_plainly(set)) return refuse("is not stored plainly in this file");
  const Handle found(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
  if (!fits(found, type)) return refuse("is of another type");
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  // lists and texts of variable length are stored as references of 16 bytes
  const auto kind = H5Tget_class(found);
  const bool referred = kind == H5T_VLEN || kind == H5T_STRING;
  const std::uintmax_t each = referred ? 16 : H5Tget_size(found);
  if (count < 0 || each == 0 || std::uintmax_t(count) > file_bytes_ / each ||
      H5Dget_storage_size(set) != std::uintmax_t(count) * each)
    return refuse("claims to contain more than the file does");
  return set;
}

Dims Reader::dims(const std::string& name, std::size_t rank, hid_t type) {
  const Handle set = dataset(name, type);
  if (!good()) return {};
  const Handle space(H5Dget_space(set), H5Sclose);
  const int found = H5Sget_simple_extent_ndims(space);
  if (found != static_cast<int>(rank)) {
    fail_because(fmt::format("{} has {} dimensions, expected {}", name, found, rank));
    return {};
  }
  Dims extents(rank);
  H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  // an empty dataset may have any extent
  for (const hsize_t extent : extents)
    if (extent > file_bytes_) fail_because(name + " claims to contain more than the file does");
  return good() ? extents : Dims(rank);
}

void Reader::read(const std::string& name, hid_t type, void* data) {
  const Handle set = dataset(name, type);
  if (good()) check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name);
}

void Reader::read_slice(const std::string& name, hid_t type, hsize_t k, void* data) {
  const Handle set = dataset(name, type);
  if (!good()) return;
  const auto [in_file, in_memory] = slice_spaces(set, k);
  check(H5Dread(set, type, in_memory, in_file, H5P_DEFAULT, data), name);
}

Handle Reader::attribute_of(const std::string& object, const char* name, H5T_class_t kind) {
  if (!good() || !linked(object) ||
      H5Aexists_by_name(file_, object.c_str(), name, H5P_DEFAULT) <= 0)
    return {};
  Handle found(H5Aopen_by_name(file_, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (found < 0) return {};
  const Handle type(H5Aget_type(found), H5Tclose), space(H5Aget_space(found), H5Sclose);
  const bool one = H5Tget_class(type) == kind && H5Sget_simple_extent_npoints(space) == 1 &&
                   H5Tget_size(type) <= longest_text;
  return one ? std::move(found) : Handle();
}

double Reader::attribute(const std::string& object, const char* name) {
  double value = 0;
  const Handle found = attribute_of(object, name, H5T_FLOAT);
  if (!good()) return value;
  if (found < 0)
    fail_because(fmt::format("{} has no number {}", object, name));
  else
    check(H5Aread(found, H5T_NATIVE_DOUBLE, &value), object + "." + name);
  return value;
}

double Reader::attribute_or(const std::string& object, const char* name, double otherwise) {
  return attribute_of(object, name, H5T_FLOAT) < 0 ? otherwise : attribute(object, name);
}

std::string Reader::text_attribute(const std::string& object, const char* name) {
  const Handle found = attribute_of(object, name, H5T_STRING);
  if (found < 0) return {};
  const Handle type(H5Aget_type(found), H5Tclose);
  if (H5Tis_variable_str(type) > 0) return {};
  // one more byte, since the text may have no zero at its end
  std::string text(H5Tget_size(type) + 1, '\0');
  check(H5Aread(found, type, text.data()), object + "." + name);
  return text.c_str();
}

bool Reader::lists_fit(const std::string& name, hid_t set, hid_t type, hid_t space) {
  hsize_t bytes = 0;
  if (!check(H5Dvlen_get_buf_size(set, type, space, &bytes), name)) return false;
  if (bytes <= file_bytes_) return true;
  fail_because(name + " claims to contain more than the file does");
  return false;
}

template <class Pointer, class Take>
void Reader::read_lists(const std::string& name, const Handle& type, const Take& take) {
  const Dims extents = dims(name, 1, type);
  if (!good()) return;
  const Handle set = dataset(name, type), space = space_of(extents);
  if (!lists_fit(name, set, type, space)) return;
  std::vector<Pointer> pointers(extents[0]);
  read(name, type, pointers.data());
  if (good())
    for (const Pointer& item : pointers) take(item);
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
}

std::vector<std::string> Reader::strings(const std::string& name) {
  std::vector<std::string> values;
  read_lists<char*>(name, string_type(),
                    [&](const char* text) { values.emplace_back(text ? text : ""); });
  return values;
}

Lists Reader::lists(const std::string& name) {
  Lists values;
  read_lists<hvl_t>(name, list_type(), [&](const hvl_t& list) {
    const int* first = static_cast<const int*>(list.p);
    values.emplace_back(first, first + list.len);
  });
  return values;
}

}  // namespace gridshell::record::hdf5

namespace gridshell::record {
namespace {

constexpr int seconds = 20;  // of processor time

/// Address space of this process in bytes; 0: not known.
std::uint64_t bytes_in_use() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

/// Limits the additional memory to what a large run needs, below the machine's memory.
void restrict_memory() {
  constexpr std::uint64_t least = std::uint64_t(1) << 30;
  const std::uint64_t now = bytes_in_use();
  rlimit space{};
  if (now == 0 || ::getrlimit(RLIMIT_AS, &space) != 0) return;
  space.rlim_cur =
      std::min<rlim_t>(space.rlim_cur, now + std::max(least, machine_memory_bytes() / 4));
  ::setrlimit(RLIMIT_AS, &space);
}

// limits memory and time, resets signal handlers, and suppresses messages and core files; the
// subprocess ends with its parent
void restrict_subprocess() {
  restrict_memory();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal :
       {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGHUP, SIGXCPU})
    std::signal(signal, SIG_DFL);
  const rlimit none{0, 0}, time{rlim_t(seconds), rlim_t(seconds + 1)};
  ::setrlimit(RLIMIT_CORE, &none);
  ::setrlimit(RLIMIT_CPU, &time);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
}

/// Calls fork() from inside a call of the HDF5 library: this thread then has the library's lock, so
/// that no other thread has it and the child can use the library. (The C library releases its own
/// locks in a child.)
pid_t forked_with_library() {
  pid_t child = -1;
  const auto fork_now = [](hid_t, const char*, void* id) {
    *static_cast<pid_t*>(id) = ::fork();
    return herr_t(1);  // once
  };
  H5Piterate(H5P_FILE_ACCESS_DEFAULT, nullptr, fork_now, &child);
  return child;
}

}  // namespace

Result<void> read_in_subprocess(const std::function<void()>& reading) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return {};
  const Descriptor from(ends[0]);
  Descriptor to(ends[1]);
  const pid_t child = forked_with_library();
  // if there can be no subprocess, the trial is left out
  if (child < 0) return {};
  if (child == 0) {
    restrict_subprocess();
    try {
      reading();
    } catch (...) {
      _exit(1);
    }
    _exit(::write(to, "", 1) == 1 ? 0 : 1);
  }
  to.close();
  // one byte reports success: the exit status is unknown where SIGCHLD is ignored
  char byte = 0;
  ssize_t bytes = 0;
  while ((bytes = ::read(from, &byte, 1)) < 0 && errno == EINTR) continue;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (bytes == 1) return {};
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return invalid("it is damaged: the HDF5 library takes more than {} s to read it", seconds);
  return invalid("it is damaged: the HDF5 library does not survive reading it");
}

}  // namespace gridshell::record
