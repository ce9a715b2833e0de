#include "experiments/diff/diff.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "render/compare.h"
#include "render/plane.h"
#include "sim/base/error.h"
#include "sim/mesh/file_extension.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

std::string size_text(const render::Image& image) {
  return std::to_string(image.width()) + " x " + std::to_string(image.height());
}

// Collects the names of pictures below a folder and the folders that links lead to.  A link to a folder that
// contains it is not followed again.
class PicturesUnder {
 public:
  explicit PicturesUnder(fs::path top) : top_(std::move(top)) { visit(top_); }

  std::set<std::string> take_names() { return std::move(names_); }

 private:
  void visit(const fs::path& folder) {
    std::error_code failure;
    const fs::path real = fs::canonical(folder, failure);
    if (std::find(open_.begin(), open_.end(), real) != open_.end()) return;
    open_.push_back(real);
    for (fs::directory_iterator i(folder, failure), end; !failure && i != end; i.increment(failure)) {
      std::error_code dangling;
      if (i->is_directory(dangling))
        visit(i->path());
      else if (file_extension(i->path()) == ".png")
        names_.insert(i->path().lexically_relative(top_).generic_string());
    }
    if (failure) throw Error::system("cannot list the folder " + folder.string() + ": " + failure.message());
    open_.pop_back();
  }

  fs::path top_;
  std::vector<fs::path> open_;  // path of folders to the current one
  std::set<std::string> names_;
};

std::set<std::string> pictures_under(const fs::path& folder) { return PicturesUnder(folder).take_names(); }

bool is_opaque(const render::Image& image) {
  if (image.channels() < 4) return true;
  for (std::size_t alpha = 3; alpha < image.pixels().size(); alpha += 4)
    if (image.pixels()[alpha] != 255) return false;
  return true;
}

render::Image on(const render::Rgb8& background, const render::Image& image) {
  render::Image result(image.width(), image.height(), background);
  render::paste(result, image, 0, 0);
  return result;
}

Measures picture_measures(const render::Image& a, const render::Image& b, const render::Plane& flip) {
  const render::Difference steps = render::compare(a, b);
  return {steps.mean_abs,     steps.rmse, steps.psnr_db,
          render::ssim(a, b), mean(flip), steps.pixels_over_8_percent};
}

// Returns the measures of two opaque pictures and the heat map of where they differ.
std::pair<Measures, render::Image> compare_looks(const render::Image& a, const render::Image& b,
                                                 const DiffFlags& flags) {
  const render::Plane flip = render::flip_map(a, b, flags.pixels_per_degree);
  return {picture_measures(a, b, flip),
          flags.map == HeatMap::flip ? render::heat_map(flip) : render::heat_map(a, b)};
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

Measures worse_measures(const Measures& a, const Measures& b) {
  Measures worst;
  for (const Measure& m : all_measures())
    worst.*m.value = m.least ? std::min(a.*m.value, b.*m.value) : std::max(a.*m.value, b.*m.value);
  return worst;
}

PictureLimits DiffFlags::picture_limits(const std::string& name) const {
  PictureLimits all = from_file.of_picture(name);
  all.set({limits});
  return all;
}

Comparison compare_files(const fs::path& a, const fs::path& b, const DiffFlags& flags) {
  render::Image of_a = render::read_png(a), of_b = render::read_png(b);
  if (of_a.width() != of_b.width() || of_a.height() != of_b.height())
    throw Error::invalid_input("pictures must have one size: " + a.string() + " has " + size_text(of_a) +
                               " pixels, " + b.string() + " " + size_text(of_b));
  return compare_pictures(std::move(of_a), std::move(of_b), flags);
}

Comparison compare_pictures(render::Image a, render::Image b, const DiffFlags& flags) {
  render::require_same_size(a, b);
  Comparison result{std::move(a), std::move(b), {}, {}};
  if (is_opaque(result.a) && is_opaque(result.b)) {
    std::tie(result.measures, result.heat) = compare_looks(result.a, result.b, flags);
    return result;
  }
  constexpr render::Rgb8 kBlack = {0, 0, 0}, kWhite = {255, 255, 255};
  auto [on_black, dark] = compare_looks(on(kBlack, result.a), on(kBlack, result.b), flags);
  auto [on_white, bright] = compare_looks(on(kWhite, result.a), on(kWhite, result.b), flags);
  result.measures = worse_measures(on_black, on_white);
  result.heat = on_white.mean_abs > on_black.mean_abs ? std::move(bright) : std::move(dark);
  return result;
}

std::ptrdiff_t FolderDiff::compared() const {
  return std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.error.empty(); });
}

std::vector<std::string> pictures_in_either(const fs::path& a, const fs::path& b) {
  std::set<std::string> names = pictures_under(a);
  names.merge(pictures_under(b));
  if (names.empty()) throw Error::invalid_input("no *.png in " + a.string() + " and " + b.string());
  return {names.begin(), names.end()};
}

FolderDiff::Row compare_in_folders(const fs::path& a, const fs::path& b, const std::string& name,
                                   const DiffFlags& flags, render::Image& heat) {
  FolderDiff::Row row{name, {}, {}, ""};
  try {
    std::error_code ignored;
    for (const fs::path& folder : {a, b})
      if (!fs::exists(folder / name, ignored)) throw Error::invalid_input("missing in " + folder.string());
    Comparison comparison = compare_files(a / name, b / name, flags);
    row.measures = comparison.measures;
    row.broken = broken_limits(row.measures, flags.picture_limits(name));
    heat = std::move(comparison.heat);
  } catch (const Error& error) {
    row.error = error.what();
    row.exit_code = error.exit_code();
  }
  return row;
}

}  // namespace hysteron::experiments
