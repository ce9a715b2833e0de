// What the calling thread has asked of its devices so far.  Tests bound it for each step: launches and
// synchronisations are counted, where a time would depend on the machine.
#pragma once

namespace hysteron {

struct DeviceCounts {
  long loops = 0;             // loops, sums, scans and sorts ordered; on a GPU a launch each
  long synchronizations = 0;  // times that the host has waited for a GPU, copies included
  long allocations = 0;       // of device memory
};
inline thread_local constinit DeviceCounts device_counts;

}  // namespace hysteron
