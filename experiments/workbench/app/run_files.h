// The files that a run has left in its folder, by its manifest: all that may be moved or removed there.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

inline constexpr const char* kManifestFile = "manifest.json";
// How a run ended that a page has started, beside what the run itself has written.
inline constexpr const char* kOutcomeFile = "outcome.json";

// Whether anything has that name, a link that leads nowhere included.
bool stands(const std::filesystem::path& file);
bool is_plain(const std::filesystem::path& file);
// Of a name in a folder.
bool stays_inside(const std::filesystem::path& name);
// One of the folders on the way from `folder` to the file of that name is a link.
bool is_behind_a_link(const std::filesystem::path& folder, const std::filesystem::path& name);
// "frames/0012.png", one of a sequence, whose files are numbered.
bool is_numbered(const std::filesystem::path& name);

// Whether there is such a file, and the mark stands in it.  Throws Error::system.
bool has_mark(const std::filesystem::path& file, const std::string& mark);

// Refuses to replace a file that `--key` names (or, without a key, the program) and the program has not
// written itself, which it knows by a `mark` in it: `what` says what it writes there, "a resolved scene".  An
// empty file is no one's.  Throws Error::invalid_input.
void require_own_file(const std::filesystem::path& file, const std::string& mark, const std::string& what,
                      const std::string& key);

// Names that the manifest lists, and those of the page and the outcome that were written since; whether they
// are there or not.
std::vector<std::filesystem::path> recorded_files(const std::optional<Manifest>& manifest,
                                                  const std::filesystem::path& folder);

// Names of the plain files that are there of the run: those that are recorded and, if it was interrupted, the
// rest of its sequences and what is half written; without its manifest.  Sequences may have files in the
// folder `beside`, too, where the run goes on.
std::set<std::filesystem::path> files_left(const std::optional<Manifest>& manifest,
                                           const std::filesystem::path& folder,
                                           const std::filesystem::path& beside = {});

// Removes them, and folders that are empty then.
void remove_files(const std::filesystem::path& folder, const std::set<std::filesystem::path>& names);
// Removes the folders of these files inside `folder` that are empty.
void remove_empty_folders(const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& names);

}  // namespace hysteron::experiments
