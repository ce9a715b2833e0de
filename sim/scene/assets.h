// Where scenes and fabrics are found.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron {

// The assets folder: environment variable HYSTERON_ASSETS, else where set_assets_place() says, else `assets`
// beside the binary or ../share/hysteron/assets from it, as installed, else in the source tree that the
// program was built from.  Throws Error::system if none exists, naming the places looked at.
std::filesystem::path assets_folder();

// Another program's place for them, which may be missing.  Before any other thread asks for assets.
void set_assets_place(const std::filesystem::path& folder);

// The file that `name` means: an existing file of that name, else assets/<kind>/<name>.toml (kind "fabrics",
// "scenes").  `origin` says who asks.  Throws Error::invalid_input with the nearest name if there is none.
std::filesystem::path find_asset(const std::string& kind, const std::string& name, const std::string& origin);

// How a record names a file: assets/... if it lies in the assets folder, which is elsewhere on every machine.
std::string asset_name(const std::filesystem::path& file);

// Names of all assets of a kind, sorted, without folder and ending.
std::vector<std::string> list_assets(const std::string& kind);

}  // namespace hysteron
