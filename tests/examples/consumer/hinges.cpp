// The hinge loop in a program that has nothing but the installed headers of the laws.
#include "../hinge/hinge_loop.h"

int main() {
  const Law law = Law::make({3e-5, 1e-5, 50});  // b1, b2 [N m], k0 [1/m]
  std::vector<Hinge> hinges = {{0.01, 0.005}, {0.01, 0.005}};
  bend(law, hinges, {0.5, 0});
  bend(law, hinges, {0, 0});
  const bool remembers = hinges[0].torque < 0 && hinges[1].torque == 0;
  return remembers ? 0 : 1;
}
