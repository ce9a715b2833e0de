// Determines which frames of several sequences of files show the same instant.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/mesh/mesh_sequence.h"

namespace hysteron::experiments {

struct TimedSequence : MeshSequence {
  double fps = 0;                   // [1/s], 0 if unknown
  std::vector<std::int64_t> frame;  // by file: its time [s] times fps
  std::vector<int> shown;           // indices of the files on the sheet, an instant each
};

// Numbers the frames of all sequences by the numbers in their files' names, so that a missing file leaves a
// gap.  Numbers are counted from the first one if all sequences begin with the same, else from 0, and in
// steps of their greatest common divisor: files 0, 10, 20 are frames 0, 1, 2.  Sequences of one rate have one
// step.  A sequence of one file, which has no number, is at the first frame of all others.  If a longer one
// has no numbers in its names, every file of every sequence is a frame.  If all have one file, nothing says
// when that was: they lose their rate.
void number_frames(const std::vector<TimedSequence*>& sequences);

// Returns a line for each sequence that lacks frames, whose files have no numbers, or, if the rate is known,
// whose numbers leave open when its files were written: in steps of more than one, or beginning with more
// than one step.  Another line reports sequences that begin at different numbers.
std::vector<std::string> frame_warnings(const std::vector<const TimedSequence*>& sequences);

// Fills `shown` with at most `most` instants at which every sequence has a file: the same frames, or the same
// times within half a frame if the rates differ.  Throws Error::invalid_input if there is no such instant.
void choose_instants(const std::vector<TimedSequence*>& sequences, int most);

}  // namespace hysteron::experiments
