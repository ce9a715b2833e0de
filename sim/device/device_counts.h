// Counts the requests of the calling thread to its devices.  Tests bound them for each step: launches and
// synchronisations are counted, where a time would depend on the machine.
#pragma once

namespace hysteron {

struct DeviceCounts {
  long loops = 0;             // loops, sums, scans and sorts ordered; on a GPU a launch each
  long synchronizations = 0;  // times that the host has waited for a GPU, copies included
  long allocations = 0;       // of device memory

  DeviceCounts& operator+=(const DeviceCounts& other) {
    loops += other.loops;
    synchronizations += other.synchronizations;
    allocations += other.allocations;
    return *this;
  }
  DeviceCounts operator-(const DeviceCounts& other) const {
    return {loops - other.loops, synchronizations - other.synchronizations, allocations - other.allocations};
  }
};
inline thread_local constinit DeviceCounts device_counts;

}  // namespace hysteron
