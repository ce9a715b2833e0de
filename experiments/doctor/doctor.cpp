// `hysteron doctor` lists which requirements of a run this machine has, and what each lack costs.
#include "experiments/doctor/findings.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/experiment.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

struct DoctorFlags {
  std::string out = "out";
  bool json = false;
};
// clang-format off
const KeyRow<DoctorFlags> kRows[] = {
    {"out", at<&DoctorFlags::out>, "", any(), "where runs would write: whose disk is looked at; nothing is written there"},
    {"json", at<&DoctorFlags::json>, "", any(), "one JSON object on stdout: `findings`, `devices` as in list, `ready`"},
};
// clang-format on

Json finding_json(const Finding& finding) {
  Json json = {{"part", finding.part}, {"found", finding.found}, {"text", finding.text}};
  if (!finding.found) json["cost"] = finding.cost;
  if (!finding.found && !finding.remedy.empty()) json["remedy"] = finding.remedy;
  json["needed"] = finding.needed;
  return json;
}

void print_json(const std::vector<TriedDevice>& devices, const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& finding : findings) list.push_back(finding_json(finding));
  const Json all = {
      {"findings", list}, {"devices", devices_json(devices)}, {"ready", lacking_parts(findings).empty()}};
  std::cout << all.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

int exit_code_of(const std::vector<Finding>& findings) { return lacking_parts(findings).empty() ? 0 : 1; }

int run_doctor(const CommandLine& line) {
  DoctorFlags flags;
  set_keys(line, bind(kRows, flags));
  if (flags.json) {
    const std::vector<TriedDevice> devices = tried_devices();
    const std::vector<Finding> all = findings(devices, flags.out);
    print_json(devices, all);
    return exit_code_of(all);
  }
  const std::vector<Finding> all = print_findings(flags.out);
  const std::vector<std::string> lacking = lacking_parts(all);
  if (lacking.empty())
    std::cout << "drape --quick runs here, with pictures\n";
  else
    std::cout << "drape --quick does not run here with pictures: lacking are " << join(lacking, ", ") << "\n";
  return exit_code_of(all);
}

}  // namespace

std::vector<Finding> print_findings(const std::filesystem::path& out) {
  const std::vector<Finding> all = findings(tried_devices(), out);
  for (const Finding& finding : all) std::cout << finding_line(finding) << "\n";
  return all;
}

Experiment doctor() {
  return {.name = "doctor",
          .question = "what this machine has of what runs need or use, and what each lack costs",
          .run = run_doctor,
          .own_keys = own_key_descriptions<kRows>};
}

}  // namespace hysteron::experiments
