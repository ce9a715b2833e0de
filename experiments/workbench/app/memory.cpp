#include "experiments/workbench/app/memory.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/base/error.h"
#include "sim/bending/laws/law_run.h"
#include "sim/scene/mesh_files.h"
#include "sim/time/together.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr double kMegabyte = 1e6;            // [bytes]
constexpr double kProgram = 32 * kMegabyte;  // and the smallest cloths

// Of double precision, a triangle [bytes].
constexpr double kCloth = 2300;        // 1300 in loops, the rest on the host
constexpr double kSolver = 750;        // block rows, multigrid
constexpr double kInFloat = 400;       // copies of matrix and bending for linear systems in float
constexpr double kSmallFactor = 1500;  // of a factorisation that is chosen by itself, which is small
constexpr double kSelfContact = 2000;  // pairs of a cloth that is crumpled
constexpr double kBlock = 72;          // 3 x 3 numbers

constexpr double kMostTrianglesByFactor = 20000;  // twice the vertices of time/method_choice.cpp

constexpr double kAnimation = 1200;                 // 200 instants of 12 bytes a vertex
constexpr double kMostAnimation = 128 * kMegabyte;  // beyond, an animation has fewer (session/animation.h)

constexpr double kOpenGl = 120 * kMegabyte;
constexpr double kScenery = 180 * kMegabyte;  // shadows and light on obstacles and ground
constexpr double kKept = 380;                 // 48 instants of 16 bytes a vertex, for the contact sheet
constexpr double kPixel = 70;                 // eight samples, eight pictures that wait [bytes]

constexpr double kReadingObj = 10;  // bytes for each in the file

// Blocks of a Cholesky factor, nested dissection of a square grid of n vertices (George 1973, 31/4 n log2 n).
double factor_blocks(double n) { return n > 1 ? 31. / 4 * n * std::log2(n) : 0; }

double solver_bytes(const Scene& scene, double triangles) {
  if (scene.integrator == Integrator::explicit_euler) return 0;
  const bool in_float = scene.solves_in_float();
  const double rows = (kSolver + (in_float ? kInFloat : 0)) * triangles;
  if (scene.linear_solver == Preconditioning::cholesky) return rows + kBlock * factor_blocks(triangles / 2);
  const bool may_factor =
      !in_float && scene.linear_solver == Preconditioning::automatic && triangles <= kMostTrianglesByFactor;
  return rows + (may_factor ? kSmallFactor * triangles : 0);
}

double history_bytes(const Scene& scene, double triangles) {
  const LawChoice law = choose_law(scene.law, scene.fabric.virgin_curve(), scene.param);
  const bool hinges = scene.element == BendingElement::hinge;
  return sizeof(double) * history_size(law, hinges ? 1 : 3) * (hinges ? 1.5 : 1) * triangles;
}

double picture_bytes(const Setup& setup, double triangles) {
  if (setup.options.no_images) return 0;
  return kOpenGl + kKept * triangles + (setup.scene.obstacle.empty() ? 0 : kScenery) +
         kPixel * setup.options.width() * setup.options.height();
}

double machine_bytes() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

// `what` needs it: "300000 triangles".
void check(const Setup& setup, double bytes, const std::string& what) {
  const int together = jobs_together();
  const double asked = setup.options.max_memory * kMegabyte,
               most = asked > 0 ? asked : machine_bytes() / together;
  if (bytes <= most) return;
  const std::string whose = together > 1 ? fmt::format(" for each of {} runs together", together) : "";
  const std::string limit = asked > 0
                                ? fmt::format("max-memory = {:g} MB (--max-memory)", setup.options.max_memory)
                                : fmt::format("the {:.0f} MB of this machine{} (--max-memory allows more)",
                                              most / kMegabyte, whose);
  throw Error::request(
      fmt::format("{} would take about {:.0f} MB of memory, more than {}", what, bytes / kMegabyte, limit))
      .of("max-memory", fmt::format("{:g}", setup.options.max_memory));
}

}  // namespace

MemoryNeed memory_need(const Setup& setup, double triangles) {
  const Scene& scene = setup.scene;
  return {.program = kProgram,
          .cloth = kCloth * triangles,
          .history = history_bytes(scene, triangles),
          .solver = solver_bytes(scene, triangles),
          .contact = scene.self_contact ? kSelfContact * triangles : 0,
          .pictures = picture_bytes(setup, triangles),
          .animation =
              setup.options.export_format == "gltf" ? std::min(kAnimation * triangles, kMostAnimation) : 0};
}

std::string text_of(const MemoryNeed& need) {
  return fmt::format("about {:.0f} MB of memory, {:.0f} of them for pictures", need.total() / kMegabyte,
                     need.pictures / kMegabyte);
}

void check_memory(const Setup& setup, double triangles) {
  const std::string pictures =
      setup.options.no_images ? "" : " and pictures of " + setup.options.size + " pixels";
  check(setup, memory_need(setup, triangles).total(), fmt::format("{:.0f} triangles{}", triangles, pictures));
}

void check_memory(const Setup& setup) {
  const std::string file = rest_file(setup.scene);
  if (file.empty()) return check_memory(setup, setup.scene.triangles);
  std::error_code missing;
  const auto bytes = static_cast<double>(fs::file_size(file, missing));
  if (!missing) check(setup, kProgram + kReadingObj * bytes + picture_bytes(setup, 0), "reading " + file);
}

}  // namespace hysteron::experiments
