#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <cstdint>
#include <cstring>

#include "engine/core/system_info.h"

namespace gridshell {
namespace {

struct Search {
  std::uintptr_t code = 0;  // an address in the object that is looked for
  std::string found;
};

/// The hash in an object's note "GNU", NT_GNU_BUILD_ID; empty if `notes` has none.
std::string identity_in(const char* notes, std::size_t size) {
  const auto padded = [](std::size_t bytes) { return (bytes + 3) / 4 * 4; };
  for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) <= size;) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes + at, sizeof head);
    const std::size_t name = at + sizeof head, bytes = name + padded(head.n_namesz);
    if (bytes + head.n_descsz > size) break;
    if (head.n_type == NT_GNU_BUILD_ID && head.n_namesz == 4 &&
        std::memcmp(notes + name, "GNU", 4) == 0) {
      std::string text;
      for (std::size_t k = 0; k < head.n_descsz; ++k)
        text += fmt::format("{:02x}", static_cast<unsigned char>(notes[bytes + k]));
      return text;
    }
    at = bytes + padded(head.n_descsz);
  }
  return {};
}

/// dl_iterate_phdr callback: 1 if the object contains this code.
int look_into(dl_phdr_info* object, std::size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  bool contains = false;
  for (int k = 0; k < object->dlpi_phnum; ++k) {
    const auto& part = object->dlpi_phdr[k];
    const std::uintptr_t from = object->dlpi_addr + part.p_vaddr;
    contains |= part.p_type == PT_LOAD && search.code - from < part.p_memsz;
  }
  for (int k = 0; contains && k < object->dlpi_phnum && search.found.empty(); ++k) {
    const auto& part = object->dlpi_phdr[k];
    if (part.p_type == PT_NOTE)
      search.found = identity_in(reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr),
                                 part.p_memsz);
  }
  return contains;
}

}  // namespace

const char* version() { return GRIDSHELL_VERSION; }

std::string build_id() {
  Search search{reinterpret_cast<std::uintptr_t>(&version), {}};
  dl_iterate_phdr(look_into, &search);
  return search.found.empty() ? version() : fmt::format("{} {}", version(), search.found);
}

}  // namespace gridshell
