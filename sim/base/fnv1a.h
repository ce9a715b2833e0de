// A hash of bytes (Fowler, Noll & Vo 1991, FNV-1a): tells states and files apart that differ by accident.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hysteron {

inline constexpr std::uint64_t kFnv1aStart = 14695981039346656037ull;

inline std::uint64_t fnv1a(const void* memory, std::size_t bytes, std::uint64_t hash = kFnv1aStart) {
  const unsigned char* p = static_cast<const unsigned char*>(memory);
  for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ p[i]) * 1099511628211ull;
  return hash;
}

}  // namespace hysteron
