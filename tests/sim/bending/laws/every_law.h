// Every law of the catalogue, and those of tests/examples, with every parameter that changes what they do,
// behind one face: tests that must hold for all of them are compiled once.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "sim/bending/laws/law_parameters.h"
#include "tests/sim/base/case_name.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {

struct LawCase {
  std::string name;  // of the law, with its variant
  std::string law;
  LawParameters parameters;
  bool passive = true;  // gives no energy back
  bool timed = false;
  int parts = 0;                     // what its fabric has beyond three numbers, of every_law.cpp's enum Part
  bool slips_on_ellipsoids = false;  // warp and weft have stops of their own
};

std::vector<LawCase> law_cases();

// A law with its history, scalar or tensor.  Scalar laws take the first component of a curvature; all that
// they give is 0 in the others.
class AnyLaw {
 public:
  struct Step {
    Vec<double, 3> moment;
    double stored, dissipated;
  };
  explicit AnyLaw(int dimension) : dimension_(dimension) {}
  virtual ~AnyLaw() = default;

  virtual void set_seconds(double seconds) = 0;                  // of the coming steps
  virtual Step to(const Vec<double, 3>& curvature) = 0;          // goes there
  virtual Step step(const Vec<double, 3>& curvature) const = 0;  // tries it
  virtual Tangent<double, 3> tangent(const Vec<double, 3>& curvature) const = 0;
  virtual Tangent<double, 3> convex_tangent(const Vec<double, 3>& curvature) const = 0;
  virtual double potential(const Vec<double, 3>& curvature) const = 0;
  virtual Vec<double, 3> residual() const = 0;
  virtual double largest_stiffness() const = 0;
  virtual bool runs_along_four_directions() const = 0;

  // Returns the part of a tensor that the law takes.
  Vec<double, 3> component(Vec<double, 3> tensor) const {
    tensor.tail(3 - dimension_).setZero();
    return tensor;
  }
  Path random_path(int count, double amplitude, unsigned seed) const {
    Path path = random_tensors(count, amplitude, seed);
    for (Vec<double, 3>& k : path) k = component(k);
    return path;
  }

 private:
  int dimension_;
};

// The case's law for this fabric, virgin; steps take `seconds`.
enum class As { kScalar, kTensor, kTensorInSinglePrecision };
std::unique_ptr<AnyLaw> any_law(const LawCase& c, As as, double seconds, const VirginCurve& curve = kCotton);

constexpr double kSeconds = 0.05;  // of a step, where time matters

// test(law) with the case's law, scalar and tensor.
template <class Test>
void for_scalar_and_tensor(const LawCase& c, double seconds, const Test& test) {
  for (const As as : {As::kScalar, As::kTensor}) {
    SCOPED_TRACE(as == As::kScalar ? "scalar" : "tensor");
    test(*any_law(c, as, seconds));
  }
}

}  // namespace hysteron::testing
