// Finds the files that a run has left in its folder, by its manifest: only these may be moved or removed
// there.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

inline constexpr const char* kManifestFile = "manifest.json";
// The file in which a page records how a run that it started has ended.
inline constexpr const char* kOutcomeFile = "outcome.json";

// `stands` is true if anything has that name, including a broken link.
bool stands(const std::filesystem::path& file);
bool is_plain(const std::filesystem::path& file);
// True if a name in a folder does not lead out of it.
bool stays_inside(const std::filesystem::path& name);
// True if one of the folders on the way from `folder` to the file of that name is a link.
bool is_behind_a_link(const std::filesystem::path& folder, const std::filesystem::path& name);
// True for a numbered file of a sequence, "frames/0012.png".
bool is_numbered(const std::filesystem::path& name);

// True if there is such a file that contains the mark.  Throws Error::system.
bool has_mark(const std::filesystem::path& file, const std::string& mark);

// Throws Error::invalid_input if the file exists and the program has not written it itself, which it
// recognises by a `mark` in it.  The message names `--key` (or, without a key, the program) and `what` it
// writes there, "a resolved scene".  An empty file may be replaced.
void require_own_file(const std::filesystem::path& file, const std::string& mark, const std::string& what,
                      const std::string& key);

// Returns the names that the manifest lists, and those of the page and the outcome that were written since,
// whether they exist or not.
std::vector<std::filesystem::path> recorded_files(const std::optional<Manifest>& manifest,
                                                  const std::filesystem::path& folder);

// Returns the names of the run's existing plain files except its manifest: the recorded ones and, if it was
// interrupted, the rest of its sequences and partly written files.  Sequences may have files in the folder
// `beside`, too, where the run goes on.
std::set<std::filesystem::path> files_left(const std::optional<Manifest>& manifest,
                                           const std::filesystem::path& folder,
                                           const std::filesystem::path& beside = {});

// Removes these files, and folders that are empty then.
void remove_files(const std::filesystem::path& folder, const std::set<std::filesystem::path>& names);
// Removes the folders of these files inside `folder` that are empty.
void remove_empty_folders(const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& names);

}  // namespace hysteron::experiments
