// Manifests on disk: the one place that knows their keys.
#pragma once

#include <filesystem>
#include <optional>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// In the order in which they stand in the file.
Json to_json(const Manifest& manifest);
Json to_json(const Metrics& metrics);
// What is missing, or of another type, is not known.
Manifest parsed_manifest(const Json& json);

// Whether the JSON of a file is a manifest.
bool is_manifest(const Json& json);
// Also one that cannot be read, which read_manifest then says.
bool has_manifest(const std::filesystem::path& folder);

// Throws Error::invalid_input, naming file and key, unless it is a manifest of hysteron whose keys are of the
// types that they have; keys that older programs did not write may be missing.  Error::system if it cannot be
// read.
Manifest read_manifest(const std::filesystem::path& file);
// The same of JSON that is_manifest() and stood in that file.
Manifest checked_manifest(const Json& json, const std::filesystem::path& file);
// Nothing where there is none, or no JSON; nothing else is checked.
std::optional<Manifest> manifest_or_none(const std::filesystem::path& file);

}  // namespace hysteron::experiments
