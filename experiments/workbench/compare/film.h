// Writes films of numbered pictures by ffmpeg.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// Returns the formats in a list such as "mp4,webp"; none for "none".  Throws Error::invalid_input for another
// one, naming `key`.
std::vector<std::string> film_formats(const std::string& key, const std::string& list);

// Writes film.FORMAT from OUT/film/0000.png, 0001.png ..., at `rate` pictures a second [1/s]: in the best
// quality whose file has at most `most_bytes`, and in fewer pixels if the least quality has more.  If ffmpeg
// cannot write it there is none, and a warning that begins with `key` and the manifest's `film_missing` give
// the reason.
void write_film(Run& run, const std::string& key, const std::string& format, double rate, double most_bytes);

}  // namespace hysteron::experiments
