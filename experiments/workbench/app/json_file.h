// Reads JSON files, which may have been cut off or edited.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// Throws Error::system if the file cannot be read; Error::invalid_input, naming it as damaged if it is empty
// or breaks off, and as no `kind` if it is no JSON or nests deeper than anything this program writes.
Json read_json(const std::filesystem::path& file, const std::string& kind = "JSON");
// Does the same for the text in that file.
Json json_in(const std::string& text, const std::filesystem::path& file, const std::string& kind = "JSON");
// Returns "is empty" or "was cut off or edited" for a file that begins as JSON and is none; "" otherwise.
std::string json_damage(const std::filesystem::path& file);
// Returns discarded JSON (Json::is_discarded) where read_json would throw.
Json json_or_none(const std::filesystem::path& file);
// Returns discarded JSON if the text is none.  It is compiled here only, because the parser takes a second to
// compile.
Json parsed_json(std::string_view text);

// Returns the value at a path of keys, "fabric.b2"; null if there is none.
const Json& json_at(const Json& json, std::string path);
// Returns "step, fabric.b2": paths whose values differ; at most a few of them, and how many more.
std::string differing_keys(const Json& keys, const Json& others);

}  // namespace hysteron::experiments
