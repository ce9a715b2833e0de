// Identifies bending friction from a free vibration: a strip hangs from a clamp, is let go, and the
// amplitudes of its free end are recorded one half period after the other.
//
// The strip moves in its first mode, which follows the amplitude A as friction saturates near the clamp
// (swinging_strip.h).  Between two turns it loses half of the energy that its friction encloses in a cycle,
//
//   dE/dA dA/dn = -1/2 D(A) (omega/omega_m)^2,   omega_m = pi over the time of the turn, as it was measured:
//
// a strip that swings faster than its mode is stiffer or lighter, and its friction acts on it by so much
// less.  Chosen here; exact for small amplitudes, and for friction that is small beside the energy stored.
#pragma once

#include "sim/identification/fab_bending.h"

namespace hysteron {

struct DecaySeries {
  std::vector<double> time, amplitude;  // of each turn, all on one side or on both [s], [m]
};
// Reads the columns `time [s]`, `amplitude [m]`.  Throws Error::system, Error::invalid_input: too few rows,
// times that do not rise, amplitudes <= 0.
DecaySeries read_decay(const std::filesystem::path& file, const std::string& reader);

struct DecayQuestion {
  double length = 0;                      // length of the strip below the clamp [m]
  double density = 0;                     // [kg/m^2]
  double rigidity = 0;                    // B [N m]
  double noise = 5e-4;                    // noise of the amplitudes [m]
  std::optional<FrictionForm> form = {};  // none: parabola_friction()
};

// Throws Error::invalid_input for amplitudes that such a strip cannot have: as large as it is long (in
// another unit, or from peak to peak), or not falling.
void check_decay(const DecaySeries& series, const DecayQuestion& question, const std::string& file);

// Returns the rows from the first amplitude on that is at most half of the strip's length, where the mode of
// small amplitudes is the strip's (at four fifths HB comes out a fifth low); all rows if fewer than six would
// remain.
DecaySeries without_large_amplitudes(const DecaySeries& series, double length);
// Says which rows were left out, or that none could be; "" where no amplitude is large.
std::string large_amplitudes_warning(const DecaySeries& series, double length);

// Warns of doubtful times of the turns: a strip of this length, weight and rigidity swings at another pace,
// or one half period is much longer than the others.
std::vector<std::string> decay_warnings(const DecaySeries& series, const DecayQuestion& question);

// Identifies the friction; `spring` is B less the part that KES-FB2 would read of the friction, and `rows`
// are the amplitudes.
FabBending identify_decay(const DecaySeries& series, const DecayQuestion& question);
// Fits other forms: friction that saturates at k0 of a grid [1/m].
std::vector<FabForm> even_forms(const DecaySeries& series, const DecayQuestion& question);

// Warns if the fit contradicts itself, because its strip swings through the smallest amplitudes at another
// pace than was measured; else "".
std::string pace_warning(const DecaySeries& series, const DecayQuestion& question, const FabBending& found);

// Returns the amplitudes [m] at the times of the series of a strip with these stops beside its rigidity that
// begins with `first` [m].
std::vector<double> decay_by(const DecaySeries& series, const DecayQuestion& question, const Spectrum& stops,
                             double first);

}  // namespace hysteron
