// fuzz FORMAT FOLDER   the files in its folder of FOLDER/seeds as they are, cut off and damaged, one after
// the other;
//                      those in FOLDER/refused/FORMAT, which once ended the program, as they are
// fuzz FORMAT FILE     one file, to see again what happened
//
// Every file is either read or refused by an Error of one line.  Anything else ends the program, at once or
// after ten seconds of one file, and leaves the file under the name that was printed first.
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>

#include "sim/base/whole_file.h"
#include "tests/fuzz/formats.h"

namespace {

using namespace hysteron;
using namespace hysteron::fuzz;
namespace fs = std::filesystem;

constexpr rlim_t kMaxMemory = rlim_t{4} << 30;  // [bytes]
constexpr std::size_t kPlaces = 150;            // where a seed is cut off, and where it is damaged

// Time of this process, not of the machine's other work; its signal ends the program.
void allow_seconds(int seconds) {
  const itimerval limit{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_VIRTUAL, &limit, nullptr);
}

void limit_memory() {
#ifndef __SANITIZE_ADDRESS__  // which reserves far more
  const rlimit limit{kMaxMemory, kMaxMemory};
  setrlimit(RLIMIT_AS, &limit);
#endif
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder))
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const fs::path& file : files) texts.push_back(whole_file(file, "cannot read " + file.string()));
  return texts;
}

// Cut off, and with another bit, at places all over the seed; half of them with check sums that are right.
std::vector<std::string> variants(const Format& format, const std::string& seed) {
  std::vector<std::string> all;
  const std::size_t stride = std::max<std::size_t>(1, seed.size() / kPlaces);
  for (std::size_t at = 0; at < seed.size(); at += stride) {
    std::string damaged = seed;
    damaged[at] = static_cast<char>(damaged[at] ^ 1 << at % 8);
    const bool repaired = format.repaired && at / stride % 2 == 0;
    for (const std::string& text : {seed.substr(0, at), damaged})
      all.push_back(repaired ? format.repaired(text) : text);
  }
  return all;
}

class Reading {
 public:
  explicit Reading(const Format& format)
      : format_(format),
        folder_(fs::temp_directory_path() / ("hysteron-fuzz-" + std::to_string(getpid()))),
        file_(folder_ / ("input" + format.ending)) {
    fs::create_directories(folder_);
  }

  const fs::path& file() const { return file_; }
  int taken(const std::string& text) const {
    fs::remove(file_);  // file systems write one that is cut short to the disk at once
    std::ofstream(file_, std::ios::binary) << text;
    allow_seconds(10);
    return fuzz::taken(format_, file_);
  }
  void is_over() const { fs::remove_all(folder_); }

 private:
  const Format& format_;
  fs::path folder_, file_;
};

int read_folder(const Format& format, const fs::path& folder) {
  const Reading reading(format);
  const std::vector<std::string> seeds = files_in(folder / "seeds" / format.seeds),
                                 refused = files_in(folder / "refused" / format.name);
  std::cout << format.name << ": " << seeds.size() << " seeds and " << refused.size()
            << " files that are refused, each in turn " << reading.file().string() << std::endl;
  if (seeds.empty()) throw std::runtime_error("no seeds");
  for (const std::string& text : refused)
    if (reading.taken(text) > 0) throw std::runtime_error("a reader takes what none should");
  long read = 0, damaged = 0;
  for (const std::string& seed : seeds) {
    const bool own = format.seeds == format.name;
    if (reading.taken(seed) == 0 && own)
      throw std::runtime_error("no reader takes one of the seeds as it is");
    for (const std::string& text : variants(format, seed)) ++damaged, read += reading.taken(text) > 0;
  }
  std::cout << read << " of " << damaged
            << " that were cut off or damaged were read by a reader, the others refused by all" << std::endl;
  reading.is_over();
  return 0;
}

int read_one(const Format& format, const fs::path& file) {
  const Reading reading(format);
  std::cout << reading.taken(whole_file(file, "cannot read " + file.string())) << " of "
            << format.readers.size() << " readers take it" << std::endl;
  reading.is_over();
  return 0;
}

int run(int count, char** words) {
  std::vector<Format> all = formats();
  for (const Format& page : pages()) all.push_back(page);
  const auto named = [&](const Format& format) { return count == 3 && format.name == words[1]; };
  const auto format = std::find_if(all.begin(), all.end(), named);
  if (format == all.end()) {
    std::cerr << "fuzz FORMAT FOLDER, or fuzz FORMAT FILE\n";
    return 2;
  }
  limit_memory();
  return fs::is_directory(words[2]) ? read_folder(*format, words[2]) : read_one(*format, words[2]);
}

}  // namespace

int main(int count, char** words) {
  try {
    return run(count, words);
  } catch (const std::exception& failure) {
    std::cerr << "fuzz: " << failure.what() << std::endl;
    return 1;
  }
}
