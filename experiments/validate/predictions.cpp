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
  CsvFile file(
      run.path("predictions.csv"),
      "predicted quantity,fitted on,predicted,low,high,measured,unit,error,error [%],measured is between");
  for (const Prediction& p : predictions)
    file.row({p.question, p.fitted_on, p.predicted, p.low, p.high, p.measured, p.unit, p.error(),
              p.error_percent(),
              !p.has_interval()       ? ""
              : p.contains_measured() ? "yes"
                                      : "no"});
  file.commit();
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
  const TextTable table = read_words(file);
  const auto column = [&](const std::string& name) {
    const auto found = std::find(table.head.begin(), table.head.end(), name);
    if (found == table.head.end())
      throw Error::invalid_input("loops: " + file.string() + " has no column \"" + name +
                                 "\": give a folder of fit --fab")
          .of("loops", folder);
    return static_cast<std::size_t>(found - table.head.begin());
  };
  const std::size_t loop = column("loop"), on = column("fitted on"), fitted = column("is fitted"),
                    area = column("area [uJ/cm]"), measured = column("measured area [uJ/cm]"),
                    one_stop = column("one stop area [uJ/cm]");
  std::vector<Prediction> predictions;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& row = table.rows[r];
    if (row[fitted] == "1") continue;
    const auto number = [&](std::size_t c) { return number_in(row[c]).value_or(NAN); };
    for (const auto& [from, with] : {std::pair{area, "stops"}, std::pair{one_stop, "one constant 2HB"}})
      predictions.push_back(
          {"loop area of " + row[loop], row[on] + ", " + with, "uJ/cm", number(from), number(measured)});
  }
  return predictions;
}

}  // namespace hysteron::experiments
