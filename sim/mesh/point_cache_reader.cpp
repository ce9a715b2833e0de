// Sources of the formats: Autodesk 3ds Max, Point Cache 2 (little-endian); NewTek LightWave, MDD
// (big-endian).
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string_view>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/whole_file.h"
#include "sim/mesh/point_cache.h"

namespace hysteron {
namespace {

static_assert(std::endian::native == std::endian::little, "PC2 is read as numbers lie in memory");

// Reads numbers of four bytes one after the other.
class Numbers4 {
 public:
  Numbers4(std::string_view bytes, bool big_endian, std::string what)
      : bytes_(bytes), big_endian_(big_endian), what_(std::move(what)) {}

  std::int32_t integer() { return std::bit_cast<std::int32_t>(word()); }
  float real() { return std::bit_cast<float>(word()); }
  std::size_t left() const { return (bytes_.size() - at_) / sizeof(std::uint32_t); }

 private:
  std::uint32_t word() {
    if (left() == 0) throw Error::invalid_input(what_ + ": it is cut off in its header");
    std::uint32_t word = 0;
    std::memcpy(&word, bytes_.data() + at_, sizeof word);
    at_ += sizeof word;
    return big_endian_ ? __builtin_bswap32(word) : word;
  }

  std::string_view bytes_;
  bool big_endian_;
  std::string what_;
  std::size_t at_ = 0;
};

struct Counts {
  std::int64_t frames, points;
};

void check_counts(const Counts& counts, const std::string& what) {
  if (counts.frames < 1 || counts.points < 1)
    throw Error::invalid_input(what + ": its header has " + std::to_string(counts.frames) + " frames of " +
                               std::to_string(counts.points) + " points; both must be >= 1");
}

void read_frames(Numbers4& numbers, const Counts& counts, const std::string& what, PointCache& cache) {
  const std::int64_t whole =
      std::min<std::int64_t>(counts.frames, static_cast<std::int64_t>(numbers.left()) / (3 * counts.points));
  if (whole < counts.frames)
    throw Error::invalid_input(what + ": it is cut off: its header has " + std::to_string(counts.frames) +
                               " frames of " + std::to_string(counts.points) + " points, and the file " +
                               std::to_string(whole));
  for (std::int64_t f = 0; f < counts.frames; ++f) {
    std::vector<Eigen::Vector3d> frame(static_cast<std::size_t>(counts.points));
    for (std::size_t v = 0; v < frame.size(); ++v) {
      for (double& x : frame[v]) x = numbers.real();
      if (!frame[v].allFinite())
        throw Error::invalid_input(what + ": point " + std::to_string(v) + " of frame " +
                                   std::to_string(f + 1) + " is not a finite number");
    }
    cache.frames.push_back(std::move(frame));
  }
}

PointCache read_pc2(std::string_view bytes, const std::string& what) {
  constexpr std::string_view kSignature("POINTCACHE2\0", 12);
  if (!bytes.starts_with(kSignature))
    throw Error::invalid_input(what + ": not a PC2: it does not begin with POINTCACHE2");
  Numbers4 numbers(bytes.substr(kSignature.size()), false, what);
  const std::int32_t version = numbers.integer(), points = numbers.integer();
  numbers.real();  // skips the first frame: the sequence begins at t = 0
  PointCache cache;
  cache.frames_per_sample = numbers.real();
  const Counts counts{numbers.integer(), points};
  if (version != 1)
    throw Error::invalid_input(what + ": version " + std::to_string(version) + " of PC2, known is 1");
  if (!(cache.frames_per_sample > 0) || !std::isfinite(cache.frames_per_sample))
    throw Error::invalid_input(what + ": a sample stands for " + number_text(cache.frames_per_sample) +
                               " frames, which must be > 0");
  check_counts(counts, what);
  read_frames(numbers, counts, what, cache);
  return cache;
}

bool ascend(const std::vector<double>& time) {
  return std::ranges::all_of(time, [](double t) { return std::isfinite(t); }) &&
         std::ranges::is_sorted(time, std::less_equal<>());
}

PointCache read_mdd(std::string_view bytes, const std::string& what) {
  Numbers4 numbers(bytes, true, what);
  Counts counts{};
  counts.frames = numbers.integer();
  counts.points = numbers.integer();
  check_counts(counts, what);
  if (static_cast<std::int64_t>(numbers.left()) < counts.frames)
    throw Error::invalid_input(what + ": it is cut off, or no MDD: its header has " +
                               std::to_string(counts.frames) + " frames");
  PointCache cache;
  for (std::int64_t f = 0; f < counts.frames; ++f) cache.time.push_back(numbers.real());
  const double first = cache.time.front();
  for (double& t : cache.time) t -= first;
  if (!ascend(cache.time)) cache.time.clear();
  read_frames(numbers, counts, what, cache);
  return cache;
}

}  // namespace

PointCache read_point_cache(const std::string& file) {
  const std::string what = "point cache " + file;
  if (!names_a_point_cache(file)) throw Error::invalid_input(what + ": its name must end in .pc2 or .mdd");
  const std::string bytes = whole_file(file, "cannot read " + what);
  return file_extension(file) == ".pc2" ? read_pc2(bytes, what) : read_mdd(bytes, what);
}

}  // namespace hysteron
