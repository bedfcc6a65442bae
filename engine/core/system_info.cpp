#include "engine/core/system_info.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace gridshell {

std::uint64_t machine_memory_bytes() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGE_SIZE);
  const std::uint64_t machine =
      pages > 0 && size > 0 ? std::uint64_t(pages) * std::uint64_t(size) : 0;
  // a container's limit; "max" if it has none
  std::uint64_t fraction = 0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> fraction && fraction > 0)
    return machine ? std::min(machine, fraction) : fraction;
  return machine;
}

}  // namespace gridshell
