#include "experiments/workbench/compare/film.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "render/image.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/process.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

namespace fs = std::filesystem;

struct Format {
  const char* name;
  const char* quality;  // the encoder's option; "" if it has none
  int best, least;      // its values; worse ones than `least` flicker
  std::vector<std::string> words;
};

// WebP and GIF repeat from the start.  WebP is lossless, because lossy pictures of smooth cloth flicker where
// nothing moves.
const std::vector<Format>& formats() {
  static const std::vector<Format> kFormats = {
      {"mp4",
       "-crf",
       8,
       28,
       {"-c:v", "libx264", "-preset", "slow", "-pix_fmt", "yuv420p", "-movflags", "+faststart"}},
      {"webp", "", 0, 0, {"-c:v", "libwebp_anim", "-pix_fmt", "bgra", "-lossless", "1", "-loop", "0"}},
      {"gif", "", 0, 0, {"-loop", "0"}}};
  return kFormats;
}

const Format& format_named(const std::string& name) {
  return *std::find_if(formats().begin(), formats().end(), [&](const Format& f) { return f.name == name; });
}

// The parameters of writing a film: the encoder's quality, and the width in pixels.
struct Attempt {
  int quality, width;
};

// Writes one file several times, each attempt replacing the one before.
class Encoder {
 public:
  Encoder(Run& run, const Format& format, double rate)
      : format_(format),
        rate_(rate),
        pictures_(run.folder() / "film" / "%04d.png"),
        file_(run.path(std::string("film.") + format.name)) {}

  // Throws Error::system if ffmpeg does not write it.
  void write(const Attempt& attempt) {
    // The picture is padded because encoders of MP4 need even sides.
    const std::string filter =
        fmt::format("scale={}:-1:flags=area,pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", attempt.width);
    std::vector<std::string> words = {
        "ffmpeg",           "-y",  "-loglevel", "error", "-framerate", number_text(rate_, 6), "-i",
        pictures_.string(), "-vf", filter};
    words.insert(words.end(), format_.words.begin(), format_.words.end());
    if (*format_.quality) words.insert(words.end(), {format_.quality, std::to_string(attempt.quality)});
    words.push_back(file_.string());
    const ProcessResult result = run_process(words, "");
    if (!result.started) throw Error::system("ffmpeg is not installed");
    if (result.exit_code != 0) throw Error::system(result.first_error_line);
    written_ = attempt;
  }
  bool fits(const Attempt& attempt, double most_bytes) {
    write(attempt);
    return bytes() <= most_bytes;
  }
  double bytes() const { return static_cast<double>(fs::file_size(file_)); }
  const Attempt& written() const { return written_; }

 private:
  const Format& format_;
  double rate_;
  fs::path pictures_, file_;
  Attempt written_{};
};

// Bisects between a quality whose file is too large and one whose file is not.
void write_best(Encoder& encoder, int too_large, int small_enough, int width, double most_bytes) {
  while (std::abs(too_large - small_enough) > 1) {
    const int between = (too_large + small_enough) / 2;
    (encoder.fits({between, width}, most_bytes) ? small_enough : too_large) = between;
  }
  if (encoder.written().quality != small_enough) encoder.write({small_enough, width});
}

// Returns a smaller width for which the next file should be small enough: a file grows with about this power
// of its width.
int narrower(int width, double times_too_large) {
  constexpr double kPower = 1.5, kReserve = 0.98, kAtOnce = 0.5;
  return static_cast<int>(width * std::max(kAtOnce, kReserve * std::pow(times_too_large, -1 / kPower)));
}

void write_within(Encoder& encoder, const Format& format, int width, double most_bytes) {
  constexpr int kNarrowest = 160;  // [pixels]
  for (; width >= kNarrowest; width = narrower(width, encoder.bytes() / most_bytes)) {
    if (encoder.fits({format.best, width}, most_bytes)) return;
    if (format.best != format.least && encoder.fits({format.least, width}, most_bytes))
      return write_best(encoder, format.best, format.least, width, most_bytes);
  }
  throw Error::system(fmt::format("{} pixels across it has {:.3g} MB, and {:.3g} are allowed",
                                  encoder.written().width, 1e-6 * encoder.bytes(), 1e-6 * most_bytes));
}

}  // namespace

std::vector<std::string> film_formats(const std::string& key, const std::string& list) {
  if (list == "none") return {};
  std::vector<std::string> known, named;
  for (const Format& format : formats()) known.emplace_back(format.name);
  for (const std::string& name : split(list)) {
    if (!std::count(known.begin(), known.end(), name))
      throw Error::invalid_input(key + " = " + list + " must be none, or of " + join(known, " | ") +
                                 ", several separated by commas (--" + key + ")" + suggestion(name, known))
          .with_key(key, list);
    if (!std::count(named.begin(), named.end(), name)) named.push_back(name);
  }
  return named;
}

void write_film(Run& run, const std::string& key, const std::string& format, double rate, double most_bytes) {
  const std::string name = "film." + format;
  const Format& asked = format_named(format);
  try {
    Encoder encoder(run, asked, rate);
    write_within(encoder, asked, render::png_size(run.folder() / "film" / "0000.png").width, most_bytes);
    std::string how =
        fmt::format("{}: {:.2f} MB, {} pixels across", name, 1e-6 * encoder.bytes(), encoder.written().width);
    if (*asked.quality) how += fmt::format(", {} {}", asked.quality + 1, encoder.written().quality);
    run.progress(how);
  } catch (const Error& error) {
    run.forget(name);
    run.manifest().film_missing = error.what();
    run.warn(key + ": there is no " + name + ": " + run.manifest().film_missing);
  }
}

}  // namespace hysteron::experiments
