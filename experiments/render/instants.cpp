#include "experiments/render/instants.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "render/contact_sheet.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

using Sequences = std::vector<TimedSequence*>;

bool have_numbers(const Sequences& sequences) {
  return std::none_of(sequences.begin(), sequences.end(),
                      [](const TimedSequence* s) { return s->number.empty(); });
}

// Returns the number in a file's name that becomes frame 0.
std::int64_t first_number(const Sequences& sequences) {
  const std::int64_t first = sequences.front()->number.front();
  const bool common = std::all_of(sequences.begin(), sequences.end(),
                                  [&](const TimedSequence* s) { return s->number.front() == first; });
  return common ? first : 0;
}

std::int64_t common_step(const Sequences& sequences, std::int64_t origin) {
  std::int64_t step = 0;
  for (const TimedSequence* s : sequences)
    for (const std::int64_t number : s->number) step = std::gcd(step, number - origin);
  return std::max<std::int64_t>(step, 1);
}

void number_from(std::int64_t origin, const Sequences& sequences) {
  const std::int64_t step = common_step(sequences, origin);
  for (TimedSequence* s : sequences) {
    s->frame = s->number;
    for (std::int64_t& frame : s->frame) frame = (frame - origin) / step;
  }
}

void number_by_names(const Sequences& sequences) {
  const std::int64_t origin = first_number(sequences);
  const bool one_rate = std::all_of(sequences.begin(), sequences.end(),
                                    [&](const TimedSequence* s) { return s->fps == sequences.front()->fps; });
  if (one_rate) return number_from(origin, sequences);
  for (TimedSequence* s : sequences) number_from(origin, {s});
}

void number_by_order(TimedSequence& sequence) {
  sequence.frame.resize(sequence.files.size());
  std::iota(sequence.frame.begin(), sequence.frame.end(), 0);
}

std::int64_t missing_frames(const TimedSequence& s) {
  return s.frame.back() - s.frame.front() + 1 - static_cast<std::int64_t>(s.frame.size());
}

// Returns the name of the file before the first gap.
std::string last_before_gap(const TimedSequence& s) {
  std::size_t i = 1;
  while (i < s.frame.size() && s.frame[i] == s.frame[i - 1] + 1) ++i;
  return s.files[i - 1].filename().string();
}

std::string unnumbered_warning(const TimedSequence& s, bool among_others) {
  return fmt::format(
      "the names of the files of {} tell no numbers ({}): frames{} are counted in the order of {}", s.name,
      s.unnumbered, among_others ? " of all sequences" : "", among_others ? "their files" : "the files");
}

// Warns if the frames of a known rate may not be at the instants when their files were written.
void add_clock_warnings(const TimedSequence& s, std::vector<std::string>& warnings) {
  const std::int64_t step = (s.number[1] - s.number[0]) / std::max<std::int64_t>(s.frame[1] - s.frame[0], 1);
  if (step > 1)
    warnings.push_back(fmt::format(
        "the numbers of the files of {} go in steps of {}, which are taken as frames that are {:.4g} s apart "
        "(--fps {:.6g}); if files between them are missing, give --fps {:.6g}",
        s.name, step, 1 / s.fps, s.fps, s.fps / static_cast<double>(step)));
  const std::int64_t first = s.number.front();
  if (s.frame.front() == 0 && first > 1 && first != step)
    warnings.push_back(fmt::format("the sequence {} begins with {}, whose number is {}: t = 0 is that file",
                                   s.name, s.files.front().filename().string(), first));
}

std::string different_first_warning(const std::vector<const TimedSequence*>& sequences) {
  const TimedSequence& first = *sequences.front();
  for (const TimedSequence* s : sequences)
    if (s->frame.front() != first.frame.front())
      return fmt::format(
          "the sequences begin at different numbers, {} with {} and {} with {}: frames beside each other "
          "have "
          "the same number, and number 0 is t = 0",
          first.name, first.number.front(), s->name, s->number.front());
  return "";
}

// Converts frames to times of one unit: seconds if every rate is known, else frames.
class Clock {
 public:
  explicit Clock(const Sequences& sequences)
      : timed_(std::all_of(sequences.begin(), sequences.end(),
                           [](const TimedSequence* s) { return s->fps > 0; })) {}

  double rate(const TimedSequence& s) const { return timed_ ? s.fps : 1; }
  double time(const TimedSequence& s, std::size_t file) const {
    return static_cast<double>(s.frame[file]) / rate(s);
  }
  double duration(const TimedSequence& s) const { return time(s, s.frame.size() - 1) - time(s, 0); }

  // Returns the index of the file within half a frame of that time.
  std::optional<int> file_at(const TimedSequence& s, double time) const {
    constexpr double kHalf = 0.5 + 1e-9;  // half a frame; times are rounded quotients
    const double frame = time * rate(s);
    const auto after =
        std::lower_bound(s.frame.begin(), s.frame.end(), static_cast<std::int64_t>(std::lround(frame)));
    if (after == s.frame.end() || std::abs(static_cast<double>(*after) - frame) > kHalf) return {};
    return static_cast<int>(after - s.frame.begin());
  }

 private:
  bool timed_;
};

// Returns the sequence whose frames are the instants: that of the lowest rate, so that the others have a
// frame near each; among equal rates the shortest.
const TimedSequence& coarsest(const Sequences& sequences, const Clock& clock) {
  return **std::min_element(sequences.begin(), sequences.end(),
                            [&](const TimedSequence* a, const TimedSequence* b) {
                              if (clock.rate(*a) != clock.rate(*b)) return clock.rate(*a) < clock.rate(*b);
                              return clock.duration(*a) < clock.duration(*b);
                            });
}

Error no_common_instant(const Sequences& sequences) {
  std::string ranges;
  for (const TimedSequence* s : sequences)
    ranges += fmt::format("{}{} has {} to {}", ranges.empty() ? "" : ", ", s->name, s->frame.front(),
                          s->frame.back());
  return Error::invalid_input("the sequences have no instant in common: of frames, " + ranges +
                              "; rename the files, or render each sequence alone");
}

}  // namespace

void number_frames(const Sequences& sequences) {
  Sequences single, several;
  for (TimedSequence* s : sequences) (s->files.size() == 1 ? single : several).push_back(s);
  if (several.empty())
    for (TimedSequence* s : single) s->fps = 0;
  if (!have_numbers(several)) {
    for (TimedSequence* s : sequences) number_by_order(*s);
    return;
  }
  if (!several.empty()) number_by_names(several);
  std::int64_t first_common = 0;
  for (const TimedSequence* s : several) first_common = std::max(first_common, s->frame.front());
  for (TimedSequence* s : single) s->frame = {first_common};
}

std::vector<std::string> frame_warnings(const std::vector<const TimedSequence*>& sequences) {
  std::vector<std::string> warnings;
  const bool frames_are_numbers = std::ranges::all_of(
      sequences, [](const TimedSequence* s) { return s->files.size() < 2 || !s->number.empty(); });
  for (const TimedSequence* s : sequences) {
    if (s->files.size() < 2) continue;
    if (s->number.empty()) {
      warnings.push_back(unnumbered_warning(*s, sequences.size() > 1));
      continue;
    }
    if (const std::int64_t missing = missing_frames(*s); missing > 0)
      warnings.push_back(fmt::format(
          "the sequence {} has no file for {} of its frames {} to {}, the first after {}: its files "
          "are frames by the numbers in their names",
          s->name, missing, s->frame.front(), s->frame.back(), last_before_gap(*s)));
    if (s->fps > 0 && frames_are_numbers) add_clock_warnings(*s, warnings);
  }
  if (const std::string warning = different_first_warning(sequences); !warning.empty())
    warnings.push_back(warning);
  return warnings;
}

void choose_instants(const Sequences& sequences, int most) {
  const Clock clock(sequences);
  const TimedSequence& base = coarsest(sequences, clock);
  std::vector<std::vector<int>> instants;  // by instant: the file of each sequence
  for (std::size_t k = 0; k < base.frame.size(); ++k) {
    std::vector<int> files;
    for (const TimedSequence* s : sequences)
      if (const auto file = clock.file_at(*s, clock.time(base, k))) files.push_back(*file);
    if (files.size() == sequences.size()) instants.push_back(std::move(files));
  }
  if (instants.empty()) throw no_common_instant(sequences);
  for (const int i : render::spread(static_cast<int>(instants.size()), most))
    for (std::size_t s = 0; s < sequences.size(); ++s) sequences[s]->shown.push_back(instants[i][s]);
}

}  // namespace hysteron::experiments
