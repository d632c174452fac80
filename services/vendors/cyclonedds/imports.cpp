#include "services/vendors/cyclonedds/imports.hpp"

#include <elf.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace roci::services::vendors::cyclonedds {
namespace {

// The parts of a loaded library's dynamic section (elf(5)) that say what it imports and where the addresses stand.
struct Imports {
  const ElfW(Sym) * symbols = nullptr;
  const char* names = nullptr;
  const ElfW(Rela) * tables[2] = {};  // of data and of calls
  std::size_t sizes[2] = {};          // in bytes
};

struct Search {
  std::uintptr_t inside = 0;
  std::string_view function;
  std::uintptr_t* slot = nullptr;
  bool read_only = false;  // PT_GNU_RELRO: what the loader has protected after it filled it in
};

bool contains(const dl_phdr_info& library, std::uintptr_t address, std::uint32_t segment) {
  for (int i = 0; i < library.dlpi_phnum; ++i) {
    const auto& part = library.dlpi_phdr[i];
    const std::uintptr_t begin = library.dlpi_addr + part.p_vaddr;
    if (part.p_type == segment && address >= begin && address - begin < part.p_memsz) return true;
  }
  return false;
}

Imports imports_of(const dl_phdr_info& library) {
  Imports imports;
  for (int i = 0; i < library.dlpi_phnum; ++i) {
    if (library.dlpi_phdr[i].p_type != PT_DYNAMIC) continue;
    const auto* entry = reinterpret_cast<const ElfW(Dyn)*>(library.dlpi_addr + library.dlpi_phdr[i].p_vaddr);
    for (; entry->d_tag != DT_NULL; ++entry) {
      const auto address = entry->d_un.d_ptr;
      if (entry->d_tag == DT_SYMTAB) imports.symbols = reinterpret_cast<const ElfW(Sym)*>(address);
      if (entry->d_tag == DT_STRTAB) imports.names = reinterpret_cast<const char*>(address);
      if (entry->d_tag == DT_RELA) imports.tables[0] = reinterpret_cast<const ElfW(Rela)*>(address);
      if (entry->d_tag == DT_RELASZ) imports.sizes[0] = entry->d_un.d_val;
      if (entry->d_tag == DT_JMPREL) imports.tables[1] = reinterpret_cast<const ElfW(Rela)*>(address);
      if (entry->d_tag == DT_PLTRELSZ) imports.sizes[1] = entry->d_un.d_val;
      if (entry->d_tag == DT_PLTREL && entry->d_un.d_val != DT_RELA) return {};
    }
  }
  return imports;
}

std::size_t symbol_of(const ElfW(Rela) & entry) {
  return sizeof(entry.r_info) == 8 ? static_cast<std::size_t>(ELF64_R_SYM(entry.r_info))
                                   : static_cast<std::size_t>(ELF32_R_SYM(entry.r_info));
}

int look_at(dl_phdr_info* library, std::size_t, void* given) {
  auto& search = *static_cast<Search*>(given);
  if (!contains(*library, search.inside, PT_LOAD)) return 0;
  const Imports imports = imports_of(*library);
  if (imports.symbols == nullptr || imports.names == nullptr) return 1;
  for (int table = 0; table < 2; ++table) {
    for (std::size_t i = 0; i < imports.sizes[table] / sizeof(ElfW(Rela)); ++i) {
      const auto& entry = imports.tables[table][i];
      const auto symbol = symbol_of(entry);
      if (symbol == 0 || search.function != imports.names + imports.symbols[symbol].st_name) continue;
      const std::uintptr_t slot = library->dlpi_addr + entry.r_offset;
      search.slot = reinterpret_cast<std::uintptr_t*>(slot);
      search.read_only = contains(*library, slot, PT_GNU_RELRO);
    }
  }
  return 1;
}

bool protect(const std::uintptr_t* slot, int rights) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(slot) / page * page;
  return mprotect(reinterpret_cast<void*>(begin), page, rights) == 0;
}

}  // namespace

void* replace_import(const void* inside, std::string_view function, void* replacement) {
  Search search{reinterpret_cast<std::uintptr_t>(inside), function};
  dl_iterate_phdr(look_at, &search);
  if (search.slot == nullptr) return nullptr;
  if (search.read_only && !protect(search.slot, PROT_READ | PROT_WRITE)) return nullptr;
  void* const before = reinterpret_cast<void*>(*search.slot);
  *search.slot = reinterpret_cast<std::uintptr_t>(replacement);
  if (search.read_only) protect(search.slot, PROT_READ);
  return before;
}

}  // namespace roci::services::vendors::cyclonedds
