#include "experiments/validate/drapes.h"

#include <fmt/core.h>

#include <cmath>

#include "experiments/workbench/compare/comparison.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {

std::map<std::string, double> measured_on(DrapeStandard standard, const Fabric& fabric) {
  std::map<std::string, double> measured;
  for (const auto& [name, metric] :
       {std::pair{"drape-coefficient", "drape_coefficient_percent"}, {"node-count", "node_count"}})
    if (const auto found = fabric.published.find(name);
        found != fabric.published.end() && found->second.tester == standard)
      measured[metric] = found->second.value;
  return measured;
}

Drape nominal_drape(const std::string& fabric, const ValidateFlags& flags) {
  const Fabric read = read_fabric(fabric, "--fabrics").fabric;
  const auto& published = read.published;
  const auto drape = published.find("drape-coefficient");
  const bool named = drape != published.end() && drape->second.tester == DrapeStandard::jis;
  const bool shaken =
      flags.standard == ValidatedTester::published ? named : flags.standard == ValidatedTester::jis;
  Drape nominal{fabric,
                flags.law,
                shaken ? DrapeStandard::jis : DrapeStandard::iso9073,
                shaken ? DrapeRelease::shaken : DrapeRelease::lowered,
                "",
                static_cast<int>(flags.triangles),
                read.name};
  nominal.measured = measured_on(nominal.standard, read);
  return nominal;
}

std::vector<Flag> drape_flags(const Drape& drape, const ValidateFlags& flags) {
  std::vector<Flag> own = {{"fabric", drape.fabric},
                           {"law", drape.law},
                           {"drape.standard", enum_name(drape.standard)},
                           {"drape.release", enum_name(drape.release)},
                           {"triangles", drape.triangles},
                           {"step", flags.step},
                           {"tolerance", flags.tolerance},
                           {"device", enum_name(flags.device)}};
  if (flags.seconds > 0) own.push_back({"seconds", flags.seconds});
  if (flags.options.quick) {
    if (drape.release != DrapeRelease::dropped) own.push_back({"drape.lowering", 0.3});
    if (drape.release == DrapeRelease::shaken) own.push_back({"drape.shakes", 1});
    if (!(flags.seconds > 0)) own.push_back({"seconds", 1.4});
  }
  own.insert(own.end(), drape.further.begin(), drape.further.end());
  return own;
}

void run_drapes(std::vector<Drape>& drapes, const ValidateFlags& flags, Run& run) {
  CommandLine line{"drape", "", {}, {}};
  if (flags.options.no_images) line.flags.push_back({"no-images", true});
  std::vector<ChildRun> columns;
  for (const Drape& drape : drapes)
    columns.push_back(child_run(drape.name(), line, drape_flags(drape, flags), run.folder()));
  run_columns(run, columns,
              {.at_once = flags.jobs,
               .resume = flags.resume,
               .gpu = flags.device != NamedDevice::cpu,
               .batch = flags.batch});
  for (std::size_t d = 0; d < drapes.size(); ++d) {
    Drape& drape = drapes[d];
    const ChildRun& column = columns[d];
    if (!column.stopped.empty()) throw Error::simulation(column.name + ": " + column.stopped);
    drape.metrics = column.manifest.value().metrics;
    drape.seconds = column.manifest->total_seconds();
    const double published = drape.published();
    run.progress(fmt::format("{}: drape coefficient {:.1f} %{}, {:.0f} nodes, {:.1f} s", drape.name(),
                             drape.coefficient(),
                             std::isnan(published) ? "" : fmt::format(" (published {:.1f})", published),
                             drape.number("node_count"), drape.seconds));
  }
}

}  // namespace hysteron::experiments
