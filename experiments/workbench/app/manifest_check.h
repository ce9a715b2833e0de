// Whether a manifest has the keys that pages are made of, of the types that they have.
#pragma once

#include <filesystem>

#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// Throws Error::request, naming the file and the key.  Keys that older programs did not write may be missing.
void check_manifest(const Json& manifest, const std::filesystem::path& file);

}  // namespace hysteron::experiments
