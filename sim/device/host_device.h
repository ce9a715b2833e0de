// These marks let one source serve both devices.  Only sim/device/ knows which compiler is at work.
// HYST_UNROLL(n) before a loop makes nvcc write its body n times: 1 where a long body would take it minutes.
// HYST_CALLED marks a function that nvcc compiles once for all loops that call it, and g++ as it likes.
#pragma once

#include <Eigen/Core>

#ifdef __CUDACC__
#define HYST_HD __host__ __device__
#define HYST_KERNEL [=] __device__
#define HYST_NOINLINE __noinline__
#define HYST_CALLED __noinline__
#define HYST_PRAGMA(text) _Pragma(#text)
#define HYST_UNROLL(times) HYST_PRAGMA(unroll(times))
#else
#define HYST_HD
#define HYST_KERNEL [=]
#define HYST_NOINLINE __attribute__((noinline))  // large functions that several loops share: compile time
#define HYST_CALLED
#define HYST_UNROLL(times)
#endif

namespace hysteron {

template <class Real, int D>
using Vec = Eigen::Matrix<Real, D, 1>;
template <class Real>
using Vec3 = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Mat3 = Eigen::Matrix<Real, 3, 3>;

}  // namespace hysteron
