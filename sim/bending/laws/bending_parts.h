// The parts of a fabric's bending beyond b1, b2 and k0: friction elements with thresholds of their own,
// branches that relax in time, permanent set, faces that differ.  Each is empty unless the fabric's file
// states it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hysteron {

// Friction elements beside the elasticity b2 are springs p_j [N m] that slip at curvatures r_j [1/m]
// (Prandtl-Ishlinskii with free thresholds; Ngo Ngoc & Boivin 2004).  For K from virgin cloth
//   M = b2 K + sum_j p_j clip(K, r_j),
// and a branch after a reversal is that curve doubled (Masing 1926).
struct Spectrum {
  std::vector<double> thresholds;   // r_j, ascending [1/m]
  std::vector<double> stiffnesses;  // p_j [N m]

  bool empty() const { return thresholds.empty() && stiffnesses.empty(); }
  std::size_t size() const { return thresholds.size(); }

  // Returns sum_j p_j: how much the first slope exceeds the last [N m].
  double stiffness() const {
    return sum([](double) { return 1.0; });
  }
  // Returns HB = sum_j p_j r_j: half the width of a loop in its middle, beyond all thresholds [N].
  double friction_moment() const {
    return sum([](double r) { return r; });
  }
  // Returns the friction on the virgin curve at this curvature >= 0 [N].
  double friction_at(double curvature) const {
    return sum([&](double r) { return std::min(curvature, r); });
  }
  // Returns 2HB of the closed loop between +-amplitude, read at this curvature [N].
  double loop_width(double amplitude, double curvature) const {
    return sum([&](double r) {
      const auto since = [&](double turn) { return std::min(std::abs(curvature - turn), 2 * r); };
      return since(-amplitude) + since(amplitude) - 2 * std::min(amplitude, r);
    });
  }
  // Returns the area that this loop encloses, 4 sum_j p_j r_j (A - r_j)+ [J/m^2].
  double loop_area(double amplitude) const {
    return 4 * sum([&](double r) { return r * std::max(0.0, amplitude - r); });
  }

 private:
  template <class Of>
  double sum(const Of& of_threshold) const {
    double total = 0;
    for (std::size_t j = 0; j < size(); ++j) total += stiffnesses[j] * of_threshold(thresholds[j]);
    return total;
  }
};

// The largest numbers that a law takes.
inline constexpr int kMaxStops = 32, kMaxBranches = 4;

// The stop j = 0..count - 1 of the `count` stops that form the parabola of b1, b2 and k0 (prandtl_stops.h):
// its threshold over k0 and its stiffness over b1 - b2.
struct ParabolaStop {
  double threshold, stiffness;
};
constexpr ParabolaStop parabola_stop(int j, int count) {
  const double squared = static_cast<double>(count) * count;
  return {(j * (j + 1) + 0.5) / squared, (2 * j + 1) / squared};
}

// Returns the stops of friction that saturates at k0 [1/m], with the total stiffness b1 - b2 [N m]; none if
// k0 = 0.
inline Spectrum parabola_stops(double stiffness, double k0, int count = kMaxStops) {
  Spectrum stops;
  for (int j = 0; k0 > 0 && j < count; ++j) {
    const ParabolaStop stop = parabola_stop(j, count);
    stops.thresholds.push_back(stop.threshold * k0);
    stops.stiffnesses.push_back(stop.stiffness * stiffness);
  }
  return stops;
}

// Springs c_i in series with dashpots, beside elasticity and friction, obey dm_i/dt = c_i dK/dt - m_i/tau_i.
struct RelaxingBranches {
  std::vector<double> times;        // tau_i, ascending [s]
  std::vector<double> stiffnesses;  // c_i [N m]

  bool empty() const { return times.empty() && stiffnesses.empty(); }
  std::size_t size() const { return times.size(); }
};

// The rest curvature K_p grows where the moment passes b2 yield + hardening K_p; without hardening there is
// none.
struct PermanentSet {
  double yield = 0;      // K_y [1/m]
  double hardening = 0;  // h [N m]

  bool on() const { return hardening > 0; }
};

// Ratios of B and 2HB of bends with K < 0 to those of bends with K > 0 (faces.h).
struct Faces {
  double bending = 1;   // ratio of B
  double friction = 1;  // ratio of the friction moment
  // Both are 1 unless friction has directions of its own: weft_elastic is the elasticity along weft over the
  // law's own, and `wider` how much wider than along warp the change from one side's friction to the other's
  // must be so that twist is convex.
  double weft_elastic = 1, wider = 1;

  bool on() const { return bending != 1 || friction != 1; }
};
// The largest VirginCurve::face_width: KES-FB2 reads B from here on [1/m].
inline constexpr double kMostFaceWidth = 50;

struct BendingParts {
  Spectrum stops;             // along warp
  Spectrum weft_stops;        // along weft, as many as along warp; none: they follow the rigidities
  RelaxingBranches branches;  // for `chapman` alone
  PermanentSet set;
  Faces faces = {};  // for `prandtl` and `linear`
};

}  // namespace hysteron
