#include "experiments/doctor/findings.h"

#include <cstdio>
#include <cstdlib>

namespace hysteron::experiments {
namespace {

// Runs before the program's own objects are constructed, some of them by such instructions, and prints a line
// in place of "Illegal instruction".
[[gnu::constructor(101)]] void refuse_other_cpu() {
  const char* missing = missing_instructions();
  if (!missing) return;
  std::fputs("hysteron: this program was built for another CPU; this one lacks ", stderr);
  std::fputs(missing, stderr);
  std::fputs(": build it here, or with -DHYSTERON_ARCH=x86-64-v2\n", stderr);
  std::_Exit(EXIT_FAILURE);
}

}  // namespace

const char* missing_instructions() {
#if defined(__x86_64__)
  __builtin_cpu_init();
#if defined(__SSE4_2__)
  if (!__builtin_cpu_supports("sse4.2")) return "SSE4.2";
#endif
#if defined(__AVX__)
  if (!__builtin_cpu_supports("avx")) return "AVX";
#endif
#if defined(__AVX2__)
  if (!__builtin_cpu_supports("avx2")) return "AVX2";
#endif
#if defined(__BMI2__)
  if (!__builtin_cpu_supports("bmi2")) return "BMI2";
#endif
#if defined(__FMA__)
  if (!__builtin_cpu_supports("fma")) return "FMA";
#endif
#if defined(__AVX512F__)
  if (!__builtin_cpu_supports("avx512f")) return "AVX-512F";
#endif
#if defined(__AVX512BW__)
  if (!__builtin_cpu_supports("avx512bw")) return "AVX-512BW";
#endif
#if defined(__AVX512DQ__)
  if (!__builtin_cpu_supports("avx512dq")) return "AVX-512DQ";
#endif
#if defined(__AVX512VL__)
  if (!__builtin_cpu_supports("avx512vl")) return "AVX-512VL";
#endif
#if defined(__AVX512VBMI__)
  if (!__builtin_cpu_supports("avx512vbmi")) return "AVX-512VBMI";
#endif
#if defined(__AVX512VNNI__)
  if (!__builtin_cpu_supports("avx512vnni")) return "AVX-512VNNI";
#endif
#endif
  return nullptr;
}

}  // namespace hysteron::experiments
