// Figures with their captions, as a page of Markdown beside them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

// A figure with its caption, for readers and for the gallery, which shows captions below its pictures.
struct FigureCaption {
  std::string file;   // in the same folder, "sheet.png"
  std::string title;  // of one line
  std::string text;   // what it shows, in sentences; one paragraph without line ends
};

// A heading, an introduction, and each figure above its caption.  Throws Error::system if the file cannot be
// written.
void write_captions(const std::filesystem::path& path, const std::string& heading,
                    const std::string& introduction, const std::vector<FigureCaption>& figures);

}  // namespace hysteron::experiments
