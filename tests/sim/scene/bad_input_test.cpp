// Every bad value ends in one line that names file and line (or flag), key, value, unit and what is allowed.
#include "sim/scene/scene_reader.h"
#include "tests/sim/base/case_name.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

using test::kAccepted;
using test::refusal;
using test::says;

struct BadScene {
  const char* name;
  std::string text;
  int line;                         // that the message must name
  std::vector<const char*> naming;  // what else the message must say
};

// Names as parts of a key, as no one writes them.
std::string nested(int parts) {
  std::string text = "step = 1e-3\na";
  for (int i = 1; i < parts; ++i) text += ".a";
  return text + " = 1\n";
}

void PrintTo(const BadScene& bad, std::ostream* out) { *out << bad.name; }

class BadSceneFile : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneFile, IsRefusedInOneLineThatNamesFileLineKeyValueAndRange) {
  const TextFile file(GetParam().text);
  const std::string reason = refusal([&] {
    Scene scene = default_scene();
    apply_scene_file(scene, file.path());
    check_scene(scene);
  });
  EXPECT_TRUE(says(reason, file.line(GetParam().line)));
  for (const char* part : GetParam().naming) EXPECT_TRUE(says(reason, part));
}

const BadScene kBadScenes[] = {
    {"NoToml", "step = = 3\n", 1, {"TOML"}},
    {"KeyBeyondAscii", "\n[\xC3\xA9]\n", 2, {"TOML", "malformed"}},
    {"LettersBeyondAscii", "\nstep\xCF\x80 = 1\n", 2, {"TOML"}},
    {"ThreeBrackets", "step = 1e-3\n[[[pin]]\n\n", 2, {"TOML", "malformed"}},
    {"TableForATableOfPhases", "[phase]\n", 1, {"phase must be an array of tables, [[phase]]"}},
    {"TablesForATable", "\n[[cloth]]\nlength = 1\n", 2, {"cloth must be one table, [cloth]"}},
    {"HalfATriangle", "triangles = 1e2\nseed = 1.5\n", 2, {"seed = 1.5 must be an integer >= 0"}},
    {"TrianglesBeyondIntegers", "triangles = 1e30\n", 1, {"triangles = 1e+30 must be in [1, 1e+08]"}},
    {"SeedBeyondIntegers", "seed = 1e30\n", 1, {"seed = 1e+30 must be an integer >= 0"}},
    {"BraceForAKey", "[}]\n", 1, {"TOML", "malformed"}},
    {"OpenBraceForAKey", "[{]\n", 1, {"TOML", "malformed"}},
    {"BraceInLists", "a=[[}\n", 1, {"TOML", "malformed"}},
    {"CommentForAKey", "[#]", 1, {"TOML", "malformed"}},
    {"LongKey", nested(100000), 2, {"TOML", "a key has more than 32 parts"}},
    {"DeepList", "a = " + std::string(100000, '[') + "\n", 1, {"TOML"}},
    {"TextOfTwoLines", "\nlaw = \"a\\nb\"\n", 2, {"a line break or another control character"}},
    {"HeavyGravity",
     "gravity = [0, 0, -1e30]\n",
     1,
     {"gravity = [0, 0, -1e+30] m/s^2 must be in [-10000, 10000]"}},
    {"MeshBesideAFile",
     "mesh = \"random\"\n[cloth]\nshape = \"file\"\nfile = \"a.obj\"\n",
     4,
     {"mesh = random", "and cloth.file = a.obj", "leave one out"}},
    {"PhasesOfOneName",
     "[[phase]]\nname = \"hang\"\n[[phase]]\nname = \"fall\"\n[[phase]]\nname = \"hang\"\n",
     5,
     {"phase[2]", "is called \"hang\" like phase[0]"}},
    {"UnknownKey", "\n\nstpe = 1e-3\n", 3, {"unknown key stpe", "did you mean step?"}},
    {"UnknownNestedKey", "[fabric]\nb3 = 1\n", 2, {"unknown key fabric.b3", "did you mean fabric.b"}},
    {"NegativeRigidity", "[fabric]\nb2 = -1\n", 2, {"fabric.b2 = -1 N m must be >= 0"}},
    {"NegativeDensity", "[fabric]\ndensity = -0.1\n", 2, {"fabric.density = -0.1 kg/m^2 must be > 0"}},
    {"ZeroDensity", "[fabric]\ndensity = 0\n", 2, {"fabric.density = 0 kg/m^2 must be > 0"}},
    {"ZeroThickness", "[fabric]\nthickness = 0\n", 2, {"fabric.thickness = 0 m must be > 0"}},
    {"NotANumber", "[fabric]\nk0 = nan\n", 2, {"fabric.k0 = nan 1/m must be finite"}},
    {"Infinite", "seconds = inf\n", 1, {"seconds = inf s must be finite"}},
    {"InfiniteComponent", "gravity = [0, 0, -inf]\n", 1, {"gravity = [0, 0, -inf] m/s^2", "finite"}},
    {"TextForNumber", "step = \"fast\"\n", 1, {"step = \"fast\"", "a number in (0, 1] [s]"}},
    {"RealForInteger", "triangles = 10.5\n", 1, {"triangles = 10.5", "an integer in [1, 1e+08]"}},
    {"TwoComponents", "gravity = [0, -9.81]\n", 1, {"gravity", "three numbers", "[m/s^2]"}},
    {"NoTriangles", "triangles = 0\n", 1, {"triangles = 0 must be in [1, 1e+08]"}},
    {"ZeroStep", "step = 0\n", 1, {"step = 0 s must be in (0, 1]"}},
    {"NegativeThreads", "threads = -2\n", 1, {"threads = -2 must be in [0, 1024]"}},
    {"NegativeSubsteps", "substeps = -1\n", 1, {"substeps = -1 must be in [0, 1e+06]"}},
    {"NegativeSeed", "seed = -1\n", 1, {"seed = -1 must be >= 0"}},
    {"HugeSeed", "seed = 4294967296\n", 1, {"seed = 4294967296 must be at most 4294967295"}},
    {"ZeroSize", "[cloth]\nlength = 0.0\n", 2, {"cloth.length = 0 m must be > 0"}},
    {"UnknownLaw", "law = \"prandl\"\n", 1, {"law = prandl must be", "did you mean prandtl?"}},
    {"IntegratorUnknown", "integrator = \"implict\"\n", 1, {"implict", "implicit"}},
    {"ToleranceWithoutAnEstimate",
     "tolerance = 1e-5\nintegrator = \"explicit\"\n",
     1,
     {"tolerance = 1e-05 m", "needs integrator", "not explicit"}},
    {"UnknownMesh", "mesh = \"randem\"\n", 1, {"mesh = randem", "FILE.obj", "did you mean random?"}},
    {"FileWithoutName", "[cloth]\nshape = \"file\"\n", 2, {"cloth.file"}},
    {"UnknownFabric",
     "fabric = \"cotton\"\n",
     1,
     {"\"cotton\"", "cotton-broad-soft, denim-c-friction, denim-c-friction-k50, feng2022-median"}},
    {"InvertedRigidities",
     "[fabric]\nb1 = 1e-6\n",
     2,
     {"fabric.b1 = 1e-06 N m", "must be >= fabric.b2 = 1.1571847e-05 N m"}},
    {"FrictionAtZeroCurvature", "[fabric]\nk0 = 0\n", 2, {"fabric.k0 = 0 1/m", "must be > 0"}},
    {"IndefiniteMembrane", "[fabric]\ncoupling = 10000\n", 2, {"fabric.coupling = 10000 N/m", "+-10000 N/m"}},
    {"ChapterForceOnShape", "force = \"chapter\"\n", 1, {"force = chapter", "element = hinge"}},
    {"UnknownParameter", "[param]\nstop = 3\n", 2, {"law prandtl", "parameter", "stop"}},
    {"ParameterOutOfRange", "[param]\nstops = 65\n", 2, {"stops = 65", "4, 8, 16 or 32"}},
    {"ParameterOfAnotherLaw",
     "law = \"linear\"\n[param]\nstops = 8\n",
     3,
     {"law linear", "unknown parameter stops = 8", "allowed: none"}},
    {"FatigueWithoutEnergy", "[param]\nfatigue.dc = 0.0\n", 2, {"fatigue.dc = 0", "> 0 J/m^2"}},
    {"FatigueOnALongMemory",
     "fabric = \"cotton-broad-k50\"\n[param]\nfatigue.dc = 1\nstops = 32\n",
     4,
     {"stops = 32 must be 8 or 16 with fatigue"}},
    {"InvertedCommandBox",
     "[[command]]\nlow = [2e3, 0, 0]\n",
     2,
     {"command[0].low must be <= command[0].high"}},
    {"EditOfAnotherLaw",
     "[[command]]\nkind = \"edit\"\n",
     2,
     {"command[0].kind = edit needs law = grinspun-edit, not prandtl"}},
    {"OnePin", "[pin]\nselect = \"box\"\n", 1, {"pin must be an array of tables, [[pin]]"}},
    {"UnknownPinKey",
     "[[pin]]\nselct = \"box\"\n",
     2,
     {"unknown key pin[0].selct", "did you mean pin[0].select?"}},
    {"InvertedPinBox", "[[pin]]\nlow = [1, 0, 0]\n", 1, {"pin[0].low", "<= pin[0].high"}},
    {"KeyframesNotAscending",
     "[[pin]]\nkeys = [\n{time = 1.0},\n{time = 1.0}]\n",
     4,
     {"pin[0].keys[1].time = 1 s", "> 1 s"}},
    {"RotationWithoutAxis",
     "[[pin]]\naxis = [0, 0, 0]\nkeys = [\n{time = 1, angle = 90}]\n",
     4,
     {"pin[0].keys[0].angle = 90 degree", "axis"}},
    {"UnknownObstacle",
     "[[obstacle]]\n[[obstacle]]\nkind = \"cone\"\n",
     3,
     {"obstacle[1].kind = cone", "ground | sphere | hollow | cylinder | box | capsule | torus"}},
    {"ZeroRadius", "[[obstacle]]\nradius = 0\n", 2, {"obstacle[0].radius = 0 m must be > 0"}},
    {"ZeroEdge", "[[obstacle]]\nsize = [1, 0, 1]\n", 2, {"obstacle[0].size = [1, 0, 1] m must be > 0"}},
    {"NoAxis", "[[obstacle]]\naxis = [0, 0, 0]\n", 1, {"obstacle[0].axis"}},
    {"NoAxisOfABox", "[[obstacle]]\nkind = \"box\"\naxis = [0, 0, 0]\n", 1, {"obstacle[0].axis"}},
    {"RimTooRound",
     "[[obstacle]]\nkind = \"cylinder\"\nheight = 0.01\nrim = 0.02\n",
     1,
     {"obstacle[0].rim = 0.02 m", "[0, 0.005]"}},
    {"FastObstacle",
     "step = 0.01\n[[obstacle]]\nkind = \"sphere\"\nradius = 0.02\n"
     "keys = [{time = 0}, {time = 0.1, position = [0, 0, 1]}]\n",
     2,
     {"obstacle[0] moves 0.1", "in a step of 0.01 s", "0.02 m", "step below 0.001"}}};

INSTANTIATE_TEST_SUITE_P(Scenes, BadSceneFile, testing::ValuesIn(kBadScenes), test::CaseName());

// Text of the file up to a quotation mark, a comment or a comma does not count for the key behind it.
TEST(LongKey, CountsThePartsOfOneKeyOnly) {
  const Scene scene = scene_of("[cloth]\nposition = [0.1, 0.2, 0.3] # a.b.c." + std::string(80, '.') +
                               "\n[param]\nmemory = \"" + std::string(80, '.') + "\"\n");
  EXPECT_EQ(scene.param.at("memory"), std::string(80, '.'));
}

std::string duration_refusal(const std::string& text, const std::vector<Flag>& flags = {}) {
  Scene scene = scene_of(text);
  apply_flags(scene, flags);
  return refusal([&] { check_duration(scene); });
}

TEST(Duration, OfASceneThatEndsBeforeItsFirstStepIsRefused) {
  EXPECT_TRUE(says(duration_refusal("step = 0.02\n", {{"seconds", 0.01}}),
                   ":1) must be <= seconds = 0.01 s (--seconds)"));
  EXPECT_EQ(duration_refusal("step = 0.02\nseconds = 0.02\n"), kAccepted);
  EXPECT_EQ(duration_refusal("step = 0.02\nseconds = 0\n"), kAccepted);  // the start alone
}

TEST(Duration, HasRoomForEveryCommand) {
  EXPECT_TRUE(says(duration_refusal("seconds = 1\n[[command]]\n[[command]]\ntime = 1.0\n"),
                   "command[1].time = 1 s", ":4) must be < seconds = 1 s"));
  EXPECT_EQ(duration_refusal("seconds = 1\n[[command]]\ntime = 0.99\n"), kAccepted);
}

TEST(BadFlag, IsRefusedInOneLineThatNamesTheFlag) {
  Scene scene = default_scene();
  const auto refused = [&](const Flag& flag) { return refusal([&] { apply_flags(scene, {flag}); }); };
  EXPECT_EQ(refused({"fabric.b2", -1}), "fabric.b2 = -1 N m must be >= 0 (--fabric.b2)");
  EXPECT_EQ(refused({"step", "1e-3s"}), "step = \"1e-3s\" must be a number in (0, 1] [s] (--step)");
  EXPECT_EQ(refused({"param", "stops"}), "param = \"stops\" must be of the form name=value (--param)");
}

TEST(BadFlag, OfNumbersLacksNoneBetweenCommas) {
  for (const char* text : {"4,,15", ",4", "4, ,15"}) {
    Scene scene;
    EXPECT_NE(test::refusal([&] { set_key(scene, "fabric.bending.stops.thresholds", text, "--thresholds"); }),
              test::kAccepted)
        << text;
  }
  Scene scene;
  set_key(scene, "fabric.bending.stops.thresholds", "[4, 15]", "--thresholds");
  EXPECT_EQ(scene.fabric.bending.stops.thresholds, (std::vector<double>{4, 15}));
}

TEST(BadFlag, ContradictingTheFabricFileNamesBothPlaces) {
  Scene scene = default_scene("wool-tropical");
  apply_flags(scene, {{"fabric.b2", 1e-3}});
  EXPECT_TRUE(says(refusal([&] { check_scene(scene); }),
                   "wool-tropical.toml:", "fabric.b2 = 0.001 N m (--fabric.b2)"));
}

TEST(BadSceneName, ThatDoesNotExistIsAWrongRequest) {
  Scene scene;
  EXPECT_TRUE(says(refusal([&] { apply_scene_file(scene, "/nowhere/drape.toml"); }), "/nowhere/drape.toml"));
}

}  // namespace
}  // namespace hysteron
