#include "experiments/workbench/pages/captions.h"

#include "sim/base/atomic_file.h"

namespace hysteron::experiments {

void write_captions(const std::filesystem::path& path, const std::string& heading,
                    const std::string& introduction, const std::vector<FigureCaption>& figures) {
  AtomicFile file(path.string());
  file.stream() << "# " << heading << "\n\n" << introduction << "\n";
  for (const FigureCaption& figure : figures)
    file.stream() << "\n![" << figure.title << "](" << figure.file << ")\n\n**" << figure.title << ".** "
                  << figure.text << "\n";
  file.commit();
}

}  // namespace hysteron::experiments
