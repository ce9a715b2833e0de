#include "sim/time/stepper.h"

#include <algorithm>
#include <chrono>
#include <type_traits>
#include <utility>

#include "sim/base/fnv1a.h"
#include "sim/device/share_positions.h"
#include "sim/time/implicit_integrator.h"
#include "sim/time/semi_implicit.h"

namespace hysteron {

namespace {

template <class Real, class Device>
void throw_if_divergence(Body<Real, Device>& body, double time) {
  if (body.is_finite()) return;
  throw Error::simulation("the simulation diverged before t = " + std::to_string(time) +
                          " s: take a smaller step (step = " + std::to_string(body.scene.step) + " s)");
}

// Makes the integrator that the body's scene names.
template <class Real, class Device>
std::unique_ptr<TimeIntegrator<Real, Device>> make_integrator(Body<Real, Device>& body,
                                                              const StepLimits& limits) {
  const Integrator named = body.scene.integrator;
  if (named == Integrator::explicit_euler) return std::make_unique<ExplicitEuler<Real, Device>>(body, limits);
  if (named == Integrator::semi_implicit && !body.self_contact)
    return std::make_unique<SemiImplicit<Real, Device>>(body, limits);
  return std::make_unique<ImplicitIntegrator<Real, Device>>(body, limits);
}

}  // namespace

template <class Real, class Device>
Stepper<Real, Device>::Stepper(std::unique_ptr<Device> device, const Scene& scene, const Cloth& cloth,
                               const CurvatureOperator& op, const StepLimits& limits)
    : Simulation(limits, op.dimension, (Device::kGpu ? "cuda: " : "cpu: ") + device->description(),
                 device->cuda_device()),
      body_(std::move(device), scene, cloth, op),
      integrator_(make_integrator(body_, limits)) {}

template <class Real, class Device>
void Stepper<Real, Device>::advance(int steps) {
  const DeviceCounts before = device_counts;
  for (int s = 0; s < steps; ++s) {
    body_.carry_out_commands(time(), time() + body_.scene.step);
    integrator_->step(time(), body_.scene.step);
    ++body_.counts.steps;
  }
  throw_if_divergence(body_, time());
  body_.counts.device += device_counts - before;
}

template <class Real, class Device>
void Stepper<Real, Device>::advance_by(double seconds) {
  const DeviceCounts before = device_counts;
  body_.carry_out_commands(time(), time() + seconds);
  integrator_->step(time(), seconds);
  ++body_.counts.steps;
  extra_time_ += seconds - body_.scene.step;
  throw_if_divergence(body_, time());
  body_.counts.device += device_counts - before;
}

template <class Real, class Device>
const Pin& Stepper<Real, Device>::pin(int number) const {
  const std::vector<Pin>& pins = body_.scene.pin;
  if (number >= 0 && number < static_cast<int>(pins.size())) return pins[number];
  const std::string text = std::to_string(number);
  throw Error::invalid_input(
      "pin = " + text +
      (pins.empty() ? ": the scene has none"
                    : " must be in [0, " + std::to_string(pins.size() - 1) + "], a pin of the scene"))
      .with_key("pin", text);
}

template <class Real, class Device>
Simulation::InPlace Stepper<Real, Device>::in_place(const Buffer<Vec3<Real>, Device>& buffer) {
  InPlace result;
  if constexpr (Device::kGpu) return result;
  if constexpr (std::is_same_v<Real, double>)
    result.fp64 = reinterpret_cast<const double*>(buffer.data());
  else
    result.fp32 = reinterpret_cast<const float*>(buffer.data());
  return result;
}

template <class Real, class Device>
std::vector<Eigen::Vector3d> Stepper<Real, Device>::positions() {
  std::vector<Eigen::Vector3d> x = cast_to<double>(body_.x.download());
  if (is_shifted())
    for (Eigen::Vector3d& p : x) p += body_.origin;
  return x;
}

template <class Real, class Device>
std::unique_ptr<GlPositions> Stepper<Real, Device>::share_positions(unsigned gl_buffer, int gl_device,
                                                                    std::string& reason) {
  if (!is_shifted()) return hysteron::share_positions(*body_.device, body_.x, gl_buffer, gl_device, reason);
  reason = "positions are relative to where the cloth starts, far from the origin";
  return nullptr;
}

template <class Real, class Device>
std::uint64_t Stepper<Real, Device>::state_hash() {
  const auto x = body_.x.download(), v = body_.v.download();
  const std::uint64_t hash = fnv1a(x.data(), x.size() * sizeof(Vec3<Real>));
  return fnv1a(v.data(), v.size() * sizeof(Vec3<Real>), hash);
}

template <class Real, class Device>
std::vector<std::pair<std::string, double>> Stepper<Real, Device>::stage_seconds() {
  StageSeconds seconds = body_.clock.seconds();
  if (body_.self_contact) {  // it runs inside the solve
    const double contact = body_.self_contact->seconds();
    seconds[static_cast<int>(Stage::contact)] += contact;
    seconds[static_cast<int>(Stage::solve)] -= contact;
  }
  std::vector<std::pair<std::string, double>> result;
  for (int s = 0; s < kStages; ++s) result.emplace_back(kStageName[s], seconds[s]);
  return result;
}

template <class Real, class Device>
double Stepper<Real, Device>::copy_bandwidth() {
  constexpr int kDoubles = 1 << 24, kRounds = 4;  // 128 MiB each way: more than any cache
  Device& device = *body_.device;
  Buffer<double, Device> from(device, kDoubles), to(device, kDoubles);
  const double* source = from.data();
  double* target = to.data();
  const auto seconds = [&](int copies) {
    wait();
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < copies; ++k)
      for_each(
          device, {"copy", 2 * kDoubles * sizeof(double)}, kDoubles,
          HYST_KERNEL(int i) { target[i] = source[i]; });
    wait();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  constexpr int kFew = 1, kMany = 5;  // their difference has no share of launching and waiting
  double few = 1e30, many = 1e30;
  for (int round = 0; round < kRounds; ++round) {
    few = std::min(few, seconds(kFew));
    many = std::min(many, seconds(kMany));
  }
  return 2.0 * kDoubles * sizeof(double) * (kMany - kFew) / (many - few);
}

template <class Real, class Device>
double Stepper<Real, Device>::launch_seconds() {
  constexpr int kLaunches = 200;
  Device& device = *body_.device;
  auto of_steps = std::exchange(device.profile, std::make_unique<KernelProfile<Device>>(device));
  for (int i = 0; i < kLaunches; ++i) for_each(device, "nothing", 1, HYST_KERNEL(int){});
  const double seconds = device.profile->costs()["nothing"].seconds / kLaunches;
  device.profile = std::move(of_steps);
  return seconds;
}

template <class Real, class Device>
std::vector<ScenePart> Stepper<Real, Device>::parts() const {
  const Scene& scene = body_.scene;
  const LawLoop<Real, Device>& law = body_.bending.law();
  const auto& contact = body_.contact;
  const auto& self_contact = body_.self_contact;
  std::vector<ScenePart> parts;
  const auto add = [&](const char* name, bool included, std::size_t bytes, const char* kernels,
                       const char* why) {
    parts.push_back({name, included, bytes, kernels, included ? "" : why});
  };
  const bool solves = scene.integrator != Integrator::explicit_euler;
  add("state", true, body_.state_bytes() + (solves ? 0 : integrator_->bytes()), "substep", "");
  add("membrane", true, body_.membrane.bytes(), "membrane stress, membrane matrix", "");
  add("implicit solve", solves, solves ? body_.matrix.bytes() + integrator_->bytes() : 0,
      "solve: start, product, advance, direction", "the integrator is explicit");
  add("membrane history", body_.membrane.has_friction(), body_.membrane.history_bytes(),
      "membrane friction, membrane history", "the fabric has no membrane.stops");
  add("bending", true, body_.bending.bytes(), "bending angles, bending law, bending forces", "");
  add("bending history", law.has_history(), law.history_bytes(), "bending law", "the law remembers nothing");
  add("commands", !scene.command.empty(), 0, "bending command", "no command");
  add("viscous damping", scene.fabric.damping > 0, 0, "bending rates, viscous loss", "fabric.damping = 0");
  add("air drag", scene.air_drag > 0, 0, "substep", "air-drag = 0");
  add("moving pins", body_.pins.any_moves(), body_.pins.bytes(), "pins", "no pin moves");
  add("obstacles", contact.has_value(), contact ? contact->bytes() + body_.before.bytes() : 0,
      "contact, contact history", "no obstacles");
  add("self-contact", self_contact.has_value(), self_contact ? self_contact->bytes() : 0,
      "self-contact: pairs, collisions, barrier, product", "self-contact = false");
  add("energy ledger", true, body_.ledger.bytes(), "substep, implicit ledger", "");
  return parts;
}

template class Stepper<double, ThisDevice>;
template class Stepper<float, ThisDevice>;

}  // namespace hysteron
