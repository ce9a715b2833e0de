// `hysteron kes` runs the KES-FB2 pure bending test on laws, alone or on strips of cloth; with --test it runs
// the tests of KES-FB1 (in_plane.h).
#include <fmt/core.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/kes/in_plane.h"
#include "experiments/kes/output.h"
#include "experiments/specimens/cantilever_strip.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pictures/pictures.h"
#include "experiments/workbench/session/run_warnings.h"
#include "render/look.h"
#include "sim/base/error.h"
#include "sim/bending/laws/unused_parameters.h"
#include "sim/reference/kes.h"
#include "sim/reference/kes_in_plane.h"
#include "sim/scene/fabric_limits.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {

struct KesFlags {
  TesterMode test = TesterMode::bending;
  std::string law = "prandtl";
  Parameters param;
  KesProtocol protocol;
  Tested on = Tested::law;
  Along along = Along::warp;
  StripShape strip;
  Options options;
};

using K = KesFlags;
using P = KesProtocol;
using S = StripShape;
// clang-format off
const KeyRow<KesFlags> kRows[] = {
    {"test", at<&K::test>, "", any(), "KES-FB2 bending, or shear or tension of KES-FB1, which take load, on, mesh, triangles and strip-steps"},
    {"law", at<&K::law>, "", any(), "NAME, several separated by commas, or all; see `hysteron list laws`"},
    {"param", at<&K::param>, "", any(), "parameters, for those of the laws that have them"},
    {"amplitude", at<&K::protocol, &P::amplitude>, "1/m", positive(), "largest curvature; the tester's is 2.5 per cm"},
    {"rate", at<&K::protocol, &P::rate>, "1/(m s)", positive(), "rate of the curvature; the tester's is 0.5 per cm and second"},
    {"slope-from", at<&K::protocol, &P::slope_from>, "1/m", at_least(0), "curvature from which the slope B is taken"},
    {"slope-to", at<&K::protocol, &P::slope_to>, "1/m", positive(), "curvature up to which the slope B is taken"},
    {"width-at", at<&K::protocol, &P::width_at>, "1/m", positive(), "curvature at which 2HB is read"},
    {"steps", at<&K::protocol, &P::steps>, "", between(10, 1e6), "accepted steps from zero to the amplitude, as they are drawn; what the tester reads of a law that takes no time does not depend on them"},
    {"cycles", at<&K::protocol, &P::cycles>, "", between(1, 1000), "number of cycles; the tester reads the first, the area is that of the last"},
    {"along", at<&K::along>, "", any(), "along which the specimen is bent, or led from clamp to clamp"},
    {"on", at<&K::on>, "", any(), "the law alone, or beside it a strip of cloth between rotating clamps"},
    {"renderer", at<&K::options, &Options::renderer>, "", any(), "how pictures of strips are drawn"},
};
const KeyRow<KesFlags> kStripRows[] = {
    {"mesh", at<&K::strip, &S::mesh>, "", any(), "of strips: aligned, aligned-45, flipped, unionjack, equilateral, random"},
    {"element", at<&K::strip, &S::element>, "", any(), "bending element of strips"},
    {"triangles", at<&K::strip, &S::triangles>, "", between(20, 1e6), "about how many a strip has; their size times the amplitude must stay small"},
    {"cloth.width", at<&K::strip, &S::width>, "m", positive(), "of strips; 1 cm is between the clamps"},
    {"strip-steps", at<&K::strip, &S::steps>, "", between(4, 1e5), "equilibria of a strip from zero to the amplitude"},
};
// clang-format on
constexpr int kQuickSteps = 1000, kQuickStripSteps = 28;

Keys option_keys(KesFlags& flags) {
  Keys keys = bind(kRows, flags);
  for (const BoundKey& key : bind(kStripRows, flags)) keys.push_back(key);
  return with_output_options(keys, flags.options);
}

// Returns the requested laws; a strip excludes grinspun-edit, as it gets no edits during the test.
std::vector<std::string> chosen_laws(const std::string& list, bool on_strip) {
  std::vector<std::string> every = law_names();
  if (on_strip) std::erase(every, "grinspun-edit");
  return listed_names("law", list, every);
}

// Returns the parameters that this law accepts; of several laws each takes its own, and one that no law has
// is refused.
LawParameters accepted_parameters(const std::string& law, const std::vector<std::string>& laws,
                                  const Parameters& given) {
  if (laws.size() == 1) return given;
  const auto has = [](const std::string& name, const std::string& parameter) {
    const std::vector<std::string> names = law_parameter_names(name);
    return std::count(names.begin(), names.end(), parameter) > 0;
  };
  LawParameters own;
  for (const auto& [name, value] : given) {
    if (has(law, name)) own[name] = value;
    if (std::none_of(laws.begin(), laws.end(),
                     [&, &name = name](const std::string& other) { return has(other, name); }))
      throw Error::invalid_input("none of the laws has a parameter " + name + " (--param)")
          .with_key("param", name + "=" + value);
  }
  return own;
}

constexpr double kJawLength = 2.5e-3;  // [m]
// Overhang beyond either edge; thickness of both halves [m].
constexpr double kJawOverhang = 0.6e-3, kJawThickness = 0.7e-3;

constexpr float kFieldOfView = 28;  // [degree]
constexpr double kReach = 9.5e-3;   // distance shown beyond clamp and jaw [m]
// Half the height shown, and the rise of its middle at the amplitude [m].
constexpr double kShown = 5.2e-3, kLift = 3.2e-3;

// Returns a jaw that is only drawn: its pins hold the cloth, which does not touch it.  It covers a strip
// along x, `width` wide from y = 0 on, between x = `from` and x = `to`; bodies are drawn smaller by the
// look's inset.
Obstacle jaw(double from, double to, double width) {
  const double inset = render::Look{}.obstacle_inset;
  Obstacle box;
  box.kind = ObstacleKind::box;
  box.center = {(from + to) / 2, width / 2, 0};
  box.size = Eigen::Vector3d((to - from) / 2, width / 2 + kJawOverhang, kJawThickness / 2).array() + inset;
  box.rim = 0.3 * inset;
  return box;
}

// Returns bounds from jaw to jaw that follow the strip up and down; `turn` from -1 to 1 is the share of the
// amplitude.
render::Box framed(double turn, float width, double half_height) {
  const double middle = turn * kLift;
  return {{-2e-3f, 0, static_cast<float>(middle - half_height)},
          {12e-3f, width, static_cast<float>(middle + half_height)}};
}

// Takes pictures of the strip in its clamps at some curvatures of the test.
class StripPictures {
 public:
  // `strip` must outlive the pictures.
  StripPictures(const Options& options, const ClampedStrip& strip)
      : setup_{strip.scene, options}, strip_(strip) {
    setup_.options.size = "960x720";
    setup_.options.camera_direction = {0.4, -1.0, 0.3};
    const double width = strip.scene.cloth.width, d = strip.spacing;
    setup_.scene.obstacle = {jaw(-kJawLength, d, width), jaw(kGauge, kGauge + d + kJawLength, width)};
    setup_.scene.obstacle[1].motion = strip.scene.pin[1].motion;
    const std::vector<std::size_t>& turn = strip.walk.start;
    rows_ = {turn[1] / 2, turn[1], (turn[1] + turn[2]) / 2, turn[2]};
  }

  // Takes a picture if the row is a chosen one; it is used as a StripWatch.
  void watch(std::size_t row, Simulation& simulation) {
    if (taken_.size() == rows_.size() || row != rows_[taken_.size()]) return;
    const float width = static_cast<float>(strip_.scene.cloth.width);
    if (!pictures_) {
      pictures_ = std::make_unique<Pictures>(setup_, strip_.cloth, simulation, framed(0, width, kReach),
                                             std::nullopt);
      renderer_ = pictures_->renderer();
    }
    StripPicture picture;
    picture.letter = static_cast<char>('a' + taken_.size());
    picture.curvature = strip_.walk.rows[row].curvature;
    const std::string caption =
        fmt::format("{}   {:.0f}/m, {}", picture.letter, picture.curvature, strip_.scene.mesh);
    const double turn = picture.curvature / strip_.walk.rows[rows_[1]].curvature;
    const auto camera = render::Camera::framing(
        framed(turn, width, kShown), setup_.options.camera_direction.cast<float>(), kFieldOfView,
        static_cast<float>(setup_.options.width()) / static_cast<float>(setup_.options.height()));
    picture.image = pictures_->picture("wireframe", camera, caption);
    taken_.push_back(std::move(picture));
    if (taken_.size() == rows_.size()) pictures_.reset();
  }

  // Returns the pictures with the moments of their rows.
  std::vector<StripPicture> taken(const StripTest& test) {
    for (std::size_t i = 0; i < taken_.size(); ++i) taken_[i].moment = test.moment[rows_[i]];
    return std::move(taken_);
  }

  std::string renderer() const { return renderer_; }

 private:
  Setup setup_;
  const ClampedStrip& strip_;
  std::unique_ptr<Pictures> pictures_;
  std::vector<std::size_t> rows_;
  std::vector<StripPicture> taken_;
  std::string renderer_;
};

// Tests one law on a strip; if no equilibrium is found, the test of other laws goes on.
StripResult strip_tested(const Fabric& fabric, const KesFlags& flags, const LawRequest& law) {
  StripResult result;
  StripShape shape = flags.strip;
  shape.warp_angle = flags.along == Along::weft ? 90 : 0;
  result.strip = clamped_strip(shape, law, fabric, flags.protocol);
  StripPictures pictures(flags.options, result.strip);
  const StripWatch watch = [&](std::size_t row, Simulation& simulation) { pictures.watch(row, simulation); };
  try {
    result.test =
        test_strip(result.strip, law, flags.protocol, flags.options.no_images ? StripWatch{} : watch);
    result.pictures = pictures.taken(result.test);
    result.renderer = pictures.renderer();
  } catch (const Error& error) {
    if (error.exit_code() != 3) throw;
    result.failure = error.what();
  }
  if (!flags.options.quiet && result.failure.empty())
    std::cerr << fabric.name << ", " << law.name << ", strip " << flags.strip.mesh << ": tested" << std::endl;
  return result;
}

// Warns of parameters that neither the laws alone nor the strips' laws read.
void warn_of_parameters(const KesTests& tests, const std::vector<std::string>& laws, const KesFlags& flags,
                        Run& run) {
  const VirginCurve curve = tests.fabric.virgin_curve();
  for (const std::string& law : laws) {
    const LawParameters own = accepted_parameters(law, laws, flags.param);
    const auto warnings = [&](LawUse use) {
      return unused_parameter_warnings(law, curve, own, use, tests.fabric.name);
    };
    const std::vector<std::string> alone = warnings(LawUse::alone);
    const std::vector<std::string> in_cloth = flags.on == Tested::strip ? warnings(LawUse::cloth) : alone;
    for (const std::string& warning : alone)
      if (std::count(in_cloth.begin(), in_cloth.end(), warning)) run.warn(warning);
    if (flags.along == Along::warp) continue;
    for (const std::string& warning :
         {weft_friction_warning(tests.fabric, law), weft_stops_warning(law, curve.parts, tests.fabric.name)})
      if (!warning.empty()) run.warn(warning);
  }
}

// Warns of too long steps, and of strips with another number of triangles than requested.
void warn_of_sizes(const CommandLine& line, const KesTests& tests, const KesFlags& flags, Run& run) {
  for (const std::string& warning : coarse_steps_warnings(tests, flags.protocol.steps, flags.strip.steps))
    run.warn(warning);
  const auto& strip = tests.results.front().strip;
  if (!strip || last_text(line.flags, "triangles", "").empty()) return;
  const std::string warning =
      triangle_count_warning(flags.strip.triangles, "--triangles", strip->strip.cloth.mesh.faces());
  if (!warning.empty()) run.warn(warning);
}

// Warns of failed strips, which are missing in the tables.
void warn_of_failures(const KesTests& tests, Run& run) {
  for (const KesResult& result : tests.results)
    if (result.strip && !result.strip->failure.empty())
      run.warn(tests.fabric.name + ", " + result.law + ", strip " + result.strip->strip.scene.mesh + ": " +
               result.strip->failure);
}

// Throws if not a single strip could be tested.
void throw_if_all_failed(const KesTests& tests) {
  for (const KesResult& result : tests.results)
    if (!result.strip || result.strip->failure.empty()) return;
  throw Error::simulation(tests.results.back().strip->failure);
}

// Throws if a rate is given and no law depends on time; relaxing branches are the fabric's, without which
// `chapman` does not.
void check_rate(const CommandLine& line, const KesFlags& flags, const std::vector<std::string>& laws,
                const Fabric& fabric) {
  const std::string rate = last_text(line.flags, "rate", "");
  const auto timed = [&](const std::string& law) {
    return takes_time({law, fabric.virgin_curve(), accepted_parameters(law, laws, flags.param)});
  };
  if (rate.empty() || std::any_of(laws.begin(), laws.end(), timed)) return;
  throw Error::invalid_input("--rate " + rate + " is not used: law " + join(laws, ", ") +
                             " takes no time, fabric " + fabric.name +
                             " having no branches that relax (fabric.bending.branches)")
      .with_key("rate", rate);
}

KesTests tested(const Fabric& fabric, const KesFlags& flags, const std::vector<std::string>& laws) {
  const VirginCurve prandtl = curve_along(fabric, flags.along);
  KesTests tests{fabric, test_in_kes({"prandtl", prandtl, {}}, flags.protocol), {}};
  for (const std::string& law : laws) {
    const LawRequest request{law, curve_along(fabric, flags.along, law),
                             accepted_parameters(law, laws, flags.param)};
    tests.results.push_back({law, laws.size() > 1 ? law : "", test_in_kes(request, flags.protocol)});
    if (flags.on == Tested::strip) tests.results.back().strip = strip_tested(fabric, flags, request);
  }
  return tests;
}

// Returns the manifest's `scene`: all keys resolved, and the fabric with its sources.
Json resolved(KesFlags& flags, const std::vector<std::string>& laws, const Fabric& fabric) {
  Json keys = to_json(bind(kRows, flags));
  if (flags.on == Tested::strip) keys.update(to_json(bind(kStripRows, flags)), true);
  keys["law"] = join(laws, ",");
  Scene scene;
  scene.fabric = fabric;
  keys["fabric"] = to_json(scene)["fabric"];
  return keys;
}

int run_kes(const CommandLine& line) {
  KesFlags flags;
  const std::string test = last_text(line.flags, "test", enum_name(flags.test));
  refuse_unread_flags(line, {{"test", test}, {"on", last_text(line.flags, "on", enum_name(flags.on))}});
  if (test != enum_name(flags.test)) return run_in_plane(line);
  set_keys(line, option_keys(flags), [&] {
    flags.protocol.steps = std::min(flags.protocol.steps, kQuickSteps);
    flags.protocol.minor_loops = false;
    flags.strip.steps = std::min(flags.strip.steps, kQuickStripSteps);
  });
  check_protocol(flags.protocol);
  const std::vector<std::string> laws = chosen_laws(flags.law, flags.on == Tested::strip);
  if (laws.empty()) throw Error::invalid_input("--law names none").with_key("law", flags.law);
  const std::string name = last_text(line.flags, "fabric", Fabric{}.name);
  const Fabric fabric = resolved_fabric(name, line.flags);
  check_rate(line, flags, laws, fabric);
  const KesTests tests = tested(fabric, flags, laws);
  throw_if_all_failed(tests);

  Run run(line, flags.options, resolved(flags, laws, fabric));
  for (const std::string& warning : checked_fabric_warnings(name, line.flags)) run.warn(warning);
  warn_of_parameters(tests, laws, flags, run);
  warn_of_sizes(line, tests, flags, run);
  warn_of_failures(tests, run);
  write_metrics(run, tests);
  write_tables(run, tests, flags.protocol);
  if (!flags.options.no_images) write_plots(run, tests, flags.protocol);
  finish_with_report(run);
  return 0;
}

// Returns the headline of a number that a tester reads.
Headline reading(const char* metric, const char* words, const char* unit, double scale = 1) {
  return {metric, words, unit, "{:.4g}", scale, kNoErrors};
}

// Returns the headline of the strip's reading relative to the law's.
Headline strip_apart(const char* metric, const char* words) {
  return {metric, words, "%", "{:+.2f}", 1, kNoErrors};
}

}  // namespace

Experiment kes() {
  return {
      .name = "kes",
      .question = "virtual KES tests: bending (B, 2HB, residual curvature), shear (G, 2HG), tension (WT, RT)",
      .run = run_kes,
      .own_keys = own_key_descriptions<option_keys, fabric_keys, in_plane_keys>,
      .conditions = {{"law | param | amplitude | rate | slope-from | slope-to | width-at | steps | cycles",
                      "test = bending"},
                     {"rate", "law = all | chapman | gong | kim | terzopoulos",
                      "a law that takes time: --law chapman, gong, kim, terzopoulos or all"},
                     {"mesh | triangles | strip-steps", "on = strip"},
                     {"element | cloth.width", "test = bending and on = strip"},
                     {"renderer", "test = bending and on = strip and not no-images"},
                     {"load", "test = tension"},
                     {"fabric.b1 | fabric.b2 | fabric.k0 | fabric.kes-b | fabric.kes-2hb | "
                      "fabric.stops-median | fabric.stops-spread | fabric.bending. | fabric.back-bending | "
                      "fabric.back-friction",
                      "test = bending"},
                     {"fabric.warp | fabric.weft | fabric.membrane.stops.warp. | fabric.membrane.stops.weft.",
                      "test = tension or on = strip"},
                     {"fabric.shear | fabric.membrane.stops.shear.", "test = shear or on = strip"}},
      .headlines = {
          .all = {reading("B_N_m", "B", "µN m", 1e6), reading("2HB_N", "2HB", "mN", 1e3),
                  reading("B_face_N_m", "B of bends to the face", "µN m", 1e6),
                  reading("B_back_N_m", "B of bends to the back", "µN m", 1e6),
                  reading("2HB_face_N", "2HB of bends to the face", "mN", 1e3),
                  reading("2HB_back_N", "2HB of bends to the back", "mN", 1e3),
                  reading("residual_curvature_per_m", "residual curvature", "1/m"),
                  reading("loop_area_J_per_m2", "area of the loop", "J/m²"),
                  strip_apart("strip_B_difference_percent", "strip's B over the law's"),
                  strip_apart("strip_2HB_difference_percent", "strip's 2HB over the law's"),
                  reading("G_N_per_m", "G", "N/m"), reading("2HG_N_per_m", "2HG", "N/m"),
                  reading("2HG5_N_per_m", "2HG5", "N/m"),
                  strip_apart("strip_G_N_per_m_difference_percent", "strip's G over the law's"),
                  reading("LT", "LT", ""), reading("WT_J_per_m2", "WT", "J/m²"),
                  reading("RT_percent", "RT", "%"), reading("EMT_percent", "EMT", "%"),
                  strip_apart("strip_WT_J_per_m2_difference_percent", "strip's WT over the law's")}}};
}

}  // namespace hysteron::experiments
