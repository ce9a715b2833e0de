// What a run's manifest says, as pieces of a page.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// Throws Error::request, naming the file, unless it is a manifest of hysteron; Error::machine if it cannot be
// read.
Json read_manifest(const std::filesystem::path& file);

// Also one that cannot be read, which read_manifest then says.
bool has_manifest(const std::filesystem::path& folder);

// Whether the JSON of a file is a manifest.
bool is_manifest(const Json& json);

// Numbers with six digits, texts without quotes.
std::string shown(const Json& value);

struct NamedUnit {
  std::string name, unit;
  std::string text() const { return name + (unit.empty() ? "" : " [" + unit + "]"); }
};
// "drape_coefficient_percent" is "drape coefficient" in %: results carry their unit at the end of their name.
NamedUnit split_unit(std::string key);
// "drape coefficient 86 %": four significant digits.
std::string metric_text(const std::string& key, double value);

// "" where a run has none, or several.
std::string fabric_name(const Json& manifest);

// "complete" or "incomplete".
std::string state_badge(const Json& manifest);

// "hysteron 0.1.0, commit 0123456789ab, modified"
std::string program_of(const Json& manifest);

}  // namespace hysteron::experiments
