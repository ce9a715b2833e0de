// Which frames of several sequences of files show the same instant.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/mesh/mesh_sequence.h"

namespace hysteron::experiments {

struct TimedSequence : MeshSequence {
  double fps = 0;                   // [1/s], 0: unknown
  std::vector<std::int64_t> frame;  // of each file; the time [s] times fps
  std::vector<int> shown;           // files that stand on the sheet, an instant each
};

// Numbers the frames of all sequences by the numbers in their files' names, so that a file that is missing
// leaves a gap.  Numbers are counted from the first one where all sequences begin with the same, else from 0,
// and in steps of their greatest common divisor: files 0, 10, 20 are frames 0, 1, 2.  Sequences of one rate
// have one step.  A sequence of one file, which has no number, stands at the first frame of all others. Where
// the names of a longer one tell no numbers, every file of every sequence is a frame.
void number_frames(const std::vector<TimedSequence*>& sequences);

// A line for each sequence that lacks frames, whose files have no numbers, or, where the rate is known, whose
// numbers leave open when its files were written: in steps of more than one, or beginning with more than one
// step.  One more where the sequences begin at different numbers.
std::vector<std::string> frame_warnings(const std::vector<const TimedSequence*>& sequences);

// Fills `shown` with at most so many instants at which every sequence has a file: the same frames, or the
// same times within half a frame where the rates differ.  Error::invalid_input if there is no such instant.
void choose_instants(const std::vector<TimedSequence*>& sequences, int most);

}  // namespace hysteron::experiments
