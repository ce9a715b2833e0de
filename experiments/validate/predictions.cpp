#include "experiments/validate/predictions.h"

#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "sim/base/csv.h"
#include "sim/base/number_in.h"
#include "sim/reference/kes.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {
namespace {

// B [gf cm^2/cm] and 2HB [gf cm/cm] as printed.
struct PublishedPair {
  const char* fabric;
  double b, two_hb;
};

// Matsudaira, Masuda, Wada, Yokura 2015, J. Textile Eng. 61(6):69, quoted second-hand (assets/fabrics), and
// the regenerated-cellulose denims A to F of Kumari & Khurana 2016, J. Textiles 4614168, Table 5 (CC BY).
constexpr PublishedPair kPairs[] = {
    {"cotton broad", 0.118, 0.124},     {"wool tropical", 0.067, 0.033}, {"polyester tropical", 0.077, 0.029},
    {"polyester faille", 0.019, 0.007}, {"denim A", 0.172, 0.139},       {"denim B", 0.144, 0.142},
    {"denim C", 0.227, 0.105},          {"denim D", 0.147, 0.141},       {"denim E", 0.207, 0.214},
    {"denim F", 0.148, 0.159},
};
constexpr FrictionShape kAssumedShape = {17, 2};  // as the fabrics' files assume

}  // namespace

void write_predictions(Run& run, const std::vector<Prediction>& predictions) {
  Table table(
      "predicted quantity,fitted on,predicted,low,high,measured,unit,error,error [%],measured is between");
  for (const Prediction& p : predictions)
    table.row({p.question, p.fitted_on, p.predicted, p.low, p.high, p.measured, p.unit, p.error(),
               p.error_percent(),
               !p.has_interval()       ? ""
               : p.contains_measured() ? "yes"
                                       : "no"});
  table.write(run.path("predictions.csv"));
}

std::vector<Prediction> predict_pairs(Run& run) {
  std::vector<Prediction> predictions;
  KesProtocol protocol;
  protocol.cycles = 1;
  protocol.minor_loops = false;
  const KesWalk walk = walk_to({protocol.amplitude, -protocol.amplitude, protocol.amplitude}, protocol);
  double worst = 0;
  for (const PublishedPair& pair : kPairs) {
    const double b = pair.b * kGramForceSquareCentimetrePerCentimetre,
                 two_hb = pair.two_hb * kGramForceCentimetrePerCentimetre;
    const ShapedFriction friction = friction_from_kes({b, two_hb}, kAssumedShape);
    const LawRequest law{
        "prandtl",
        {friction.b2 + friction.stops.stiffness(), friction.b2, 1, {friction.stops, {}, {}, {}}},
        {}};
    const KesReading read = read_loop(protocol, walk, run_law(law, walk.rows).moment);
    const std::string on = "B, 2HB; the shape of friction assumed",
                      fabric = std::string(" of ") + pair.fabric;
    predictions.push_back({"B" + fabric, on, "N m", read.rigidity, b});
    predictions.push_back({"2HB" + fabric, on, "N", read.loop_width, two_hb});
  }
  for (const Prediction& p : predictions) worst = std::max(worst, std::abs(p.error_percent()));
  run.metric("kes_pairs_largest_error_percent", worst);
  run.progress(fmt::format("KES pairs: {} numbers come back within {:.2g} %", predictions.size(), worst));
  return predictions;
}

std::vector<Prediction> predict_loops(const std::string& folder) {
  const std::filesystem::path file = std::filesystem::path(folder) / "predictions.csv";
  const Table all = read_table(file);
  if (!all.find("is fitted"))
    throw Error::invalid_input("loops: " + file.string() + " has no column \"is fitted\": give a folder of " +
                               "fit --fab")
        .with_key("loops", folder);
  const Table table = all.where("is fitted", "0");
  std::vector<Prediction> predictions;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    for (const auto& [area, with] :
         {std::pair{"area [uJ/cm]", "stops"}, std::pair{"one stop area [uJ/cm]", "one constant 2HB"}})
      predictions.push_back({"loop area of " + table.word(r, "loop"),
                             table.word(r, "fitted on") + ", " + with, "uJ/cm", table.number(r, area),
                             table.number(r, "measured area [uJ/cm]")});
  return predictions;
}

}  // namespace hysteron::experiments
