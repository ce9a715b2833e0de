// Finds scenes and fabrics.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron {

// Returns the assets folder: environment variable HYSTERON_ASSETS, else the place of set_assets_place(), else
// `assets` beside the binary or ../share/hysteron/assets from it, as installed, else that of the source tree
// that the program was built from.  Throws Error::system if none exists, naming the places looked at.
std::filesystem::path assets_folder();

// Sets the place of the assets of another program, which may be missing.  Has to be called before any other
// thread asks for assets.
void set_assets_place(const std::filesystem::path& folder);

// Returns the file that `name` means: an existing file of that name or that asset_name() has named so, else
// assets/<kind>/<name>.toml (kind "fabrics", "scenes").  `origin` says who asks.  Throws Error::invalid_input
// with the nearest name if there is none.
std::filesystem::path find_asset(const std::string& kind, const std::string& name, const std::string& origin);

// Returns a file's name for records: assets/... if it lies in the assets folder, which is elsewhere on every
// machine; else, and in an installation without assets, the file as it is.
std::string asset_name(const std::filesystem::path& file);
// Returns where the file, or the pattern of several, that asset_name() has named is on this machine; a name
// that does not begin with assets/ as it is.
std::filesystem::path asset_place(const std::string& name);

// Lists the names of all assets of a kind, sorted, without folder and ending.
std::vector<std::string> list_assets(const std::string& kind);

}  // namespace hysteron
