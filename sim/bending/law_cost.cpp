#include "sim/bending/law_cost.h"

#include <algorithm>
#include <chrono>
#include <random>

namespace hysteron {
namespace {

constexpr int kFrames = 8;      // different sets of curvatures, visited in turn
constexpr int kBatches = 7;     // the median of their times is taken
constexpr int kRounds = 4;      // through all frames in a batch
constexpr double kBias = 0.25;  // of warp and of weft in each hinge's direction, that of 45 degrees

// Every element sees D angles of its own, so that its curvature is what the frame says.
template <class Real, class Device>
struct Elements {
  int count, dimension;
  Buffer<Real, Device> area, coefficient, direction, moment_area;
  Buffer<int, Device> start, hinge;
  std::vector<Buffer<Real, Device>> frame;  // curvatures [1/m]

  Elements(Device& device, int elements, int d, double largest)
      : count(elements),
        dimension(d),
        area(device, std::vector<Real>(elements, 1)),
        coefficient(device, identities(elements, d)),
        direction(device, std::vector<Real>(d == 1 ? 2 * static_cast<std::size_t>(elements) : 0, kBias)),
        moment_area(device, static_cast<std::size_t>(elements) * d),
        start(device, multiples(elements + 1, d)),
        hinge(device, multiples(elements * d, 1)) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<Real> curvature(static_cast<Real>(-largest), static_cast<Real>(largest));
    for (int f = 0; f < kFrames; ++f) {
      std::vector<Real> values(static_cast<std::size_t>(elements) * d);
      for (Real& k : values) k = curvature(generator);
      frame.emplace_back(device, values);
    }
  }
  OperatorView<Real> view() const {
    return {count, area.data(), start.data(), hinge.data(), coefficient.data(), direction.data()};
  }

  static std::vector<Real> identities(int elements, int d) {
    std::vector<Real> result(static_cast<std::size_t>(elements) * d * d);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = (i / d) % d == i % d ? 1 : 0;
    return result;
  }
  static std::vector<int> multiples(int number, int of) {
    std::vector<int> result(number);
    for (int i = 0; i < number; ++i) result[i] = i * of;
    return result;
  }
};

}  // namespace

template <class Real, class Device>
LawCost law_cost(Device& device, const LawChoice& choice, int dimension, int elements) {
  const auto law = make_law_loop<Real>(device, choice, dimension, elements);
  Elements<Real, Device> all(device, elements, dimension, 2 * choice.curve.k0);
  const auto round = [&] {
    for (const auto& frame : all.frame)
      law->commit(device, all.view(), frame.data(), Real(1e-3), {0, nullptr, nullptr},
                  all.moment_area.data());
  };
  round();
  std::vector<double> seconds;
  for (int batch = 0; batch < kBatches; ++batch) {
    device.synchronize();
    const auto start = std::chrono::steady_clock::now();
    for (int r = 0; r < kRounds; ++r) round();
    device.synchronize();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(seconds.begin(), seconds.end());
  return {1e9 * seconds[kBatches / 2] / (static_cast<double>(kRounds) * kFrames * elements),
          static_cast<double>(law->history_bytes()) / elements};
}

template LawCost law_cost<double>(ThisDevice&, const LawChoice&, int, int);
template LawCost law_cost<float>(ThisDevice&, const LawChoice&, int, int);

}  // namespace hysteron
