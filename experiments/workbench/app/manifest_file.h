// Reads and writes manifests; no other file knows their keys.
#pragma once

#include <filesystem>
#include <optional>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// The keys are in the order of the file.
Json to_json(const Manifest& manifest);
Json to_json(const Metrics& metrics);
// Values that are missing or of another type stay unknown.
Manifest parsed_manifest(const Json& json);

// True if the JSON of a file is a manifest.
bool is_manifest(const Json& json);
// True also for an unreadable manifest, which read_manifest then reports.
bool has_manifest(const std::filesystem::path& folder);

// Throws Error::invalid_input, naming file and key, unless it is a manifest of hysteron whose keys have the
// right types; keys that older programs did not write may be missing.  Throws Error::system if it cannot be
// read.
Manifest read_manifest(const std::filesystem::path& file);
// Does the same for JSON that is_manifest() and was in that file.
Manifest checked_manifest(const Json& json, const std::filesystem::path& file);
// Returns nothing if there is no such file or no JSON in it; nothing else is checked.
std::optional<Manifest> manifest_or_none(const std::filesystem::path& file);

}  // namespace hysteron::experiments
