#include "experiments/workbench/app/this_program.h"

#include <elf.h>
#include <fmt/core.h>
#include <link.h>

#include <cstring>
#include <filesystem>
#include <string_view>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/app/version.h"
#include "sim/base/error.h"
#include "sim/base/fnv1a.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {

// The instruction set of this build: sums of vectors of another width round differently.
constexpr const char* kIsa =
#if defined(__AVX512F__)
    "x86-64-v4";
#elif defined(__AVX2__) && defined(__FMA__)
    "x86-64-v3";
#elif defined(__SSE4_2__)
    "x86-64-v2";
#elif defined(__x86_64__)
    "x86-64";
#else
    "others";
#endif

// Returns the compiler, because compilers vectorise differently, which changes the last bits.
std::string compiler_name() {
#if defined(__clang__)
  return "clang++ " + std::to_string(__clang_major__);
#elif defined(__GNUC__)
  return "g++ " + std::to_string(__GNUC__);
#else
  return "others";
#endif
}

std::string hexadecimal(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return text;
}

// Returns the description of the build ID among the notes of a segment; "" if there is none.
std::string_view build_id_in(std::string_view notes) {
  constexpr auto kAligned = [](std::size_t bytes) { return (bytes + 3) / 4 * 4; };
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes.data(), sizeof head);
    const std::size_t name = sizeof head, description = name + kAligned(head.n_namesz);
    if (description + head.n_descsz > notes.size()) return {};
    if (head.n_type == NT_GNU_BUILD_ID && notes.substr(name, head.n_namesz) == std::string_view("GNU", 4))
      return notes.substr(description, head.n_descsz);
    notes.remove_prefix(std::min(notes.size(), description + kAligned(head.n_descsz)));
  }
  return {};
}

// Is called with each loaded object; the executable is the first.
int take_build_id(dl_phdr_info* object, std::size_t, void* target) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const char* const begin = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
    const std::string_view id = build_id_in({begin, segment.p_memsz});
    if (!id.empty()) *static_cast<std::string*>(target) = hexadecimal(id);
  }
  return 1;
}

std::string found_build() {
  std::string build;
  dl_iterate_phdr(take_build_id, &build);
  if (!build.empty()) return build;
  const std::string bytes = whole_file("/proc/self/exe");
  return fmt::format("{:016x}", fnv1a(bytes.data(), bytes.size()));
}

}  // namespace

const std::string& program_build() {
  static const std::string kBuild = found_build();
  return kBuild;
}

Manifest this_program() {
  Manifest manifest;
  manifest.version = kVersion;
  manifest.commit = kGitCommit;
  manifest.isa = kIsa;
  manifest.compiler = compiler_name();
  manifest.build = program_build();
  manifest.dirty = kGitDirty;
  return manifest;
}

std::string program_change(const Manifest& before) {
  if (program_version(before) != program_version())
    return "its program is " + program_version(before) + ", not " + program_version();
  if (before.build != program_build()) return "its program is another build of " + program_version();
  return "";
}

std::string program_version(const Manifest& m) {
  return m.version + " (commit " + m.commit + (m.dirty ? ", modified)" : ")");
}

std::string program_version() { return program_version(this_program()); }

}  // namespace hysteron::experiments
