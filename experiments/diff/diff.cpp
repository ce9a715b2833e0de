#include "experiments/diff/diff.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "render/compare.h"
#include "render/ssim.h"
#include "sim/base/error.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

std::string size_text(const render::Image& image) {
  return std::to_string(image.width()) + " x " + std::to_string(image.height());
}

std::set<std::string> pictures_under(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code failure;
  for (fs::recursive_directory_iterator i(folder, failure), end; !failure && i != end; i.increment(failure)) {
    if (i->path().extension() == ".png" && !i->is_directory())
      names.insert(i->path().lexically_relative(folder).generic_string());
  }
  if (failure) throw Error::machine("cannot list the folder " + folder.string() + ": " + failure.message());
  return names;
}

// "missing in B: 0003.png, 0004.png"; "" if none is.
std::string missing_text(const std::set<std::string>& all, const std::set<std::string>& there,
                         const fs::path& folder) {
  constexpr std::size_t kMostNames = 20;  // in a message of one line
  std::vector<std::string> missing;
  std::set_difference(all.begin(), all.end(), there.begin(), there.end(), std::back_inserter(missing));
  if (missing.empty()) return "";
  const std::size_t more = missing.size() - std::min(kMostNames, missing.size());
  missing.resize(missing.size() - more);
  return "missing in " + folder.string() + ": " + join(missing, ", ") +
         (more ? " and " + std::to_string(more) + " more" : "");
}

}  // namespace

Measures no_limits() { return {kInfinity, kInfinity, -kInfinity, -kInfinity, kInfinity, kInfinity}; }

const std::array<Measure, 6>& all_measures() {
  using M = Measures;
  static const std::array<Measure, 6> all = {{
      {"mean_abs", "mean_abs [steps]", "max-mean", &M::mean_abs, false},
      {"rmse", "rmse [steps]", "max-rmse", &M::rmse, false},
      {"psnr_db", "psnr [dB]", "min-psnr", &M::psnr_db, true},
      {"ssim", "ssim", "min-ssim", &M::ssim, true},
      {"flip", "flip", "max-flip", &M::flip, false},
      {"pixels_over_8_percent", "pixels_over_8 [%]", "max-pixels-over-8", &M::pixels_over_8_percent, false},
  }};
  return all;
}

Measures worst_of(const Measures& a, const Measures& b) {
  Measures worst;
  for (const Measure& m : all_measures())
    worst.*m.value = m.least ? std::min(a.*m.value, b.*m.value) : std::max(a.*m.value, b.*m.value);
  return worst;
}

PictureLimits DiffFlags::limits_of(const std::string& name) const {
  PictureLimits all = from_file.of_picture(name);
  all.set({limits});
  return all;
}

Comparison compare_files(const fs::path& a, const fs::path& b, const DiffFlags& flags) {
  render::Image of_a = render::read_png(a), of_b = render::read_png(b);
  if (of_a.width() != of_b.width() || of_a.height() != of_b.height())
    throw Error::request("pictures must have one size: " + a.string() + " has " + size_text(of_a) +
                         " pixels, " + b.string() + " " + size_text(of_b));
  return compare_pictures(std::move(of_a), std::move(of_b), flags);
}

Comparison compare_pictures(render::Image a, render::Image b, const DiffFlags& flags) {
  Comparison result{std::move(a), std::move(b), {}, {}};
  const render::Difference steps = render::compare(result.a, result.b);
  const render::Plane flip = render::flip_map(result.a, result.b, flags.pixels_per_degree);
  result.measures = {steps.mean_abs, steps.rmse,
                     steps.psnr_db,  render::ssim(result.a, result.b),
                     mean(flip),     steps.pixels_over_8_percent};
  result.heat = flags.map == "flip" ? render::heat_map(flip) : render::heat_map(result.a, result.b);
  return result;
}

std::vector<std::string> paired_pictures(const fs::path& a, const fs::path& b) {
  const std::set<std::string> in_a = pictures_under(a), in_b = pictures_under(b);
  const std::string from_b = missing_text(in_a, in_b, b), from_a = missing_text(in_b, in_a, a);
  if (!from_a.empty() || !from_b.empty())
    throw Error::request("every picture must be in both folders; " + from_b +
                         (from_a.empty() || from_b.empty() ? "" : "; ") + from_a);
  if (in_a.empty()) throw Error::request("no *.png in " + a.string() + " and " + b.string());
  return {in_a.begin(), in_a.end()};
}

}  // namespace hysteron::experiments
