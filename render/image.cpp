#include "render/image.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "render/srgb.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

thread_local std::size_t pixels_read = 0;

// Which source pixels one target pixel covers along a side, and how much of each.
struct Footprint {
  int first;
  std::vector<float> weights;
};

std::vector<Footprint> footprints(int source, int target) {
  const double scale = static_cast<double>(source) / target;
  std::vector<Footprint> result(static_cast<size_t>(target));
  for (int i = 0; i < target; ++i) {
    const double begin = i * scale, end = std::min((i + 1) * scale, static_cast<double>(source));
    Footprint& footprint = result[i];
    footprint.first = static_cast<int>(begin);
    for (int k = footprint.first; k < end && k < source; ++k)
      footprint.weights.push_back(
          static_cast<float>((std::min(end, k + 1.0) - std::max(begin, k * 1.0)) / scale));
  }
  return result;
}

// One target row of linear light, times alpha where there is one: columns summed over the rows' footprint
// first, then along x.
std::vector<float> summed_columns(const Image& source, const Footprint& rows) {
  std::vector<float> sums(source.row_bytes(), 0.0f);
  pixels_read += rows.weights.size() * static_cast<std::size_t>(source.width());
  const auto& linear = linear_of_srgb8();
  for (size_t k = 0; k < rows.weights.size(); ++k) {
    const std::uint8_t* row = source.at(0, rows.first + static_cast<int>(k));
    if (source.channels() == 3) {
      for (size_t i = 0; i < sums.size(); ++i) sums[i] += rows.weights[k] * linear[row[i]];
      continue;
    }
    for (size_t i = 0; i < sums.size(); i += 4) {
      const float alpha = rows.weights[k] * static_cast<float>(row[i + 3]) / 255;
      for (size_t c = 0; c < 3; ++c) sums[i + c] += alpha * linear[row[i + c]];
      sums[i + 3] += alpha;
    }
  }
  return sums;
}

// Stores light that was multiplied by alpha, if there are four channels.
void store(std::uint8_t* pixel, const std::array<float, 4>& light, int channels) {
  const float share = channels == 4 ? std::max(light[3], 1e-6f) : 1;
  for (int c = 0; c < 3; ++c) pixel[c] = srgb8_of_linear(light[c] / share);
  if (channels == 4) pixel[3] = static_cast<std::uint8_t>(255 * std::min(light[3], 1.0f) + 0.5f);
}

}  // namespace

Image::Image(int width, int height, int channels) : width_(width), height_(height), channels_(channels) {
  if (width <= 0 || height <= 0)
    throw Error::request("picture of " + std::to_string(width) + " x " + std::to_string(height) +
                         " pixels: both sides must be >= 1");
  if (channels != 3 && channels != 4)
    throw Error::request("picture of " + std::to_string(channels) +
                         " channels: 3 (RGB) or 4 (RGBA) are allowed");
  pixels_.assign(row_bytes() * height, 0);
}

Image::Image(int width, int height, const Rgb8& fill) : Image(width, height, 3) {
  for (size_t i = 0; i < pixels_.size(); ++i) pixels_[i] = fill[i % 3];
}

void paste(Image& target, const Image& source, int x, int y) {
  const int left = std::max(0, -x), right = std::min(source.width(), target.width() - x);
  for (int row = std::max(0, -y); row < std::min(source.height(), target.height() - y); ++row)
    for (int column = left; column < right; ++column) {
      const std::uint8_t* from = source.at(column, row);
      std::uint8_t* to = target.at(x + column, y + row);
      const int alpha = source.channels() == 4 ? from[3] : 255;
      for (int c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>((alpha * from[c] + (255 - alpha) * to[c] + 127) / 255);
    }
}

std::size_t pixels_shrunk() { return pixels_read; }

Image shrink(const Image& source, int width, int height) {
  if (width > source.width() || height > source.height())
    throw Error::request("shrinking a picture of " + std::to_string(source.width()) + " x " +
                         std::to_string(source.height()) + " to " + std::to_string(width) + " x " +
                         std::to_string(height) + " pixels: no side may grow");
  Image result(width, height, source.channels());
  const auto columns = footprints(source.width(), width);
  const auto rows = footprints(source.height(), height);
  const int channels = source.channels();
  for (int y = 0; y < height; ++y) {
    const auto sums = summed_columns(source, rows[y]);
    for (int x = 0; x < width; ++x) {
      std::array<float, 4> light{};
      for (size_t k = 0; k < columns[x].weights.size(); ++k)
        for (int c = 0; c < channels; ++c)
          light[c] += columns[x].weights[k] * sums[(columns[x].first + k) * channels + c];
      store(result.at(x, y), light, channels);
    }
  }
  return result;
}

}  // namespace hysteron::render
