#include "experiments/bench/batch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "experiments/bench/wall_clock.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"
#include "sim/time/together.h"

namespace hysteron::experiments {
namespace {

constexpr int kAlone = 4;        // cloths that run by themselves, too
constexpr double kSpread = 0.5;  // of b1
constexpr int kDistinct = 16;    // values of b1

// What one cloth has done.
struct Share {
  double begun = 0, ended = 0, ready = 0;  // of its timed steps, and of its making, on one clock [s]
  double linear_iterations = 0;            // a step
  std::uint64_t state_hash = 0;
  std::string device;
};

class Cloths {
 public:
  Cloths(const Scene& scene, const BatchChoice& choice)
      : scene_(scene), choice_(choice), cloth_(make_cloth(scene)) {}

  int triangles() const { return cloth_.mesh.faces(); }

  Share take(int i) const {
    Scene scene = scene_;
    scene.fabric.b1 *= 1 + kSpread * (i % kDistinct) / kDistinct;
    Share share;
    const auto simulation = make_simulation(scene, cloth_);
    share.ready = clock_.seconds();
    simulation->advance(std::max(1, static_cast<int>(std::lround(choice_.after / scene.step))));
    simulation->wait();
    share.begun = clock_.seconds();
    const long iterations = simulation->solver_counts().linear;
    simulation->advance(choice_.steps);
    simulation->wait();
    share.ended = clock_.seconds();
    share.linear_iterations =
        static_cast<double>(simulation->solver_counts().linear - iterations) / choice_.steps;
    share.state_hash = simulation->state_hash();
    share.device = simulation->device();
    return share;
  }

  std::vector<Share> together(int count) const {
    std::vector<Share> shares(count);
    run_together(scene_.device == DeviceChoice::cuda, count, choice_.threads,
                 [&](int i) { shares[i] = take(i); });
    return shares;
  }
  double seconds() const { return clock_.seconds(); }

 private:
  Scene scene_;
  BatchChoice choice_;
  Cloth cloth_;
  Stopwatch clock_;
};

template <class Number>
Number most(const std::vector<Share>& shares, Number Share::*number) {
  Number result = shares.front().*number;
  for (const Share& share : shares) result = std::max(result, share.*number);
  return result;
}

double first_begun(const std::vector<Share>& shares) {
  double first = shares.front().begun;
  for (const Share& share : shares) first = std::min(first, share.begun);
  return first;
}

}  // namespace

std::vector<Metrics> times_together(const Scene& scene, const BatchChoice& choice,
                                    const std::function<void(const Metrics&)>& measured) {
  const Cloths cloths(scene, choice);
  std::vector<Metrics> rows;
  std::vector<Share> alone;
  double rate_alone = 0;
  const auto add = [&](double count, double seconds, double setup, double iterations, double equal) {
    const double rate = count * choice.steps / seconds;
    if (rate_alone == 0) rate_alone = rate;
    rows.push_back({{"cloths", count},
                    {"triangles", cloths.triangles()},
                    {"ms_per_step", 1e3 * seconds / choice.steps},
                    {"cloth_steps_per_second", rate},
                    {"times_one_at_a_time", rate / rate_alone},
                    {"solver_iterations_per_step", iterations},
                    {"setup_seconds", setup},
                    {"equal_states", equal},
                    {"device", alone.front().device}});
    measured(rows.back());
  };
  const double start = cloths.seconds();
  double seconds = 0, setup = 0;
  for (int i = 0; i < kAlone; ++i) {
    const double before = i == 0 ? start : alone.back().ended;
    alone.push_back(cloths.take(i));
    seconds += (alone.back().ended - alone.back().begun) / kAlone;
    setup += (alone.back().ready - before) / kAlone;
  }
  add(1, seconds, setup, most(alone, &Share::linear_iterations), kAlone);
  for (const double count : choice.cloths) {
    const double begin = cloths.seconds();
    const std::vector<Share> shares = cloths.together(static_cast<int>(count));
    int equal = 0;
    for (std::size_t i = 0; i < std::min(shares.size(), alone.size()); ++i)
      equal += shares[i].state_hash == alone[i].state_hash;
    add(count, most(shares, &Share::ended) - first_begun(shares), most(shares, &Share::ready) - begin,
        most(shares, &Share::linear_iterations), equal);
  }
  return rows;
}

}  // namespace hysteron::experiments
