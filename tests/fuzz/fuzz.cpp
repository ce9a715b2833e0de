// fuzz FORMAT SEEDS COUNT [FIRST]   COUNT changed copies of the files in the folder SEEDS, one after the
// other fuzz FORMAT FILE                  one file, to see again what happened
//
// Every file is either read or refused by an Error of one line.  Anything else ends the program, at once or
// after ten seconds of one file, and leaves the file under the name that was printed first.
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "tests/fuzz/formats.h"
#include "tests/fuzz/mutation.h"

namespace {

using namespace hysteron;
using namespace hysteron::fuzz;
namespace fs = std::filesystem;

constexpr rlim_t kMostMemory = rlim_t{4} << 30;  // [bytes]

// Time of this process, not of the machine's other work; its signal ends the program.
void allow_seconds(int seconds) {
  const itimerval limit{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_VIRTUAL, &limit, nullptr);
}

void limit_memory() {
#ifndef __SANITIZE_ADDRESS__  // which reserves far more
  const rlimit limit{kMostMemory, kMostMemory};
  setrlimit(RLIMIT_AS, &limit);
#endif
}

// How many of the readers took it.
int read_all(const Format& format, const fs::path& file) {
  int taken = 0;
  for (const auto& reader : format.readers) {
    allow_seconds(10);
    try {
      reader(file);
      ++taken;
    } catch (const Error& error) {
      const std::string message = error.what();
      if (message.empty() || message.find_first_of("\n\r") != message.npos)
        throw std::runtime_error("an error of several lines or none: " + message);
    }
  }
  return taken;
}

std::vector<std::string> seeds_in(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == "." + ending) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const fs::path& file : files) seeds.push_back(whole_file(file, "cannot read " + file.string()));
  return seeds;
}

// What stands beside the files that are read: a run whose manifest is whole.
fs::path workplace(const Format& format, const fs::path& seeds) {
  const fs::path folder = fs::temp_directory_path() / ("hysteron-fuzz-" + std::to_string(getpid()));
  fs::create_directories(folder / "results" / "run");
  if (format.name == "csv")
    fs::copy_file(seeds / "manifest.json", folder / "results" / "run" / "manifest.json");
  return folder;
}

int fuzz_format(const Format& format, const fs::path& folder, std::uint64_t count, std::uint64_t first) {
  const std::vector<std::string> seeds = seeds_in(folder, format.name);
  const fs::path work = workplace(format, folder), file = work / ("input." + format.name);
  std::cout << format.name << ": " << seeds.size() << " seeds, " << count << " files from number " << first
            << " on, each in turn " << file.string() << std::endl;
  long taken = 0;
  for (const std::string& seed : seeds) {
    std::ofstream(file, std::ios::binary) << seed;
    if (read_all(format, file) == 0) throw std::runtime_error("no reader takes one of the seeds as it is");
  }
  for (std::uint64_t number = first; number < first + count; ++number) {
    std::string text = Mutation(number, format.words).of(seeds);
    if (format.repaired && number % 2 == 0) text = format.repaired(text);
    std::ofstream(file, std::ios::binary) << text;
    taken += read_all(format, file) > 0;
  }
  std::cout << taken << " of them were read by a reader, the others refused by all" << std::endl;
  fs::remove_all(work);
  return 0;
}

int run(int count, char** words) {
  const auto named = [&](const Format& format) { return count > 1 && format.name == words[1]; };
  const auto format = std::find_if(formats().begin(), formats().end(), named);
  if (format == formats().end() || count < 3 || count > 5) {
    std::cerr << "fuzz FORMAT SEEDS COUNT [FIRST], or fuzz FORMAT FILE\n";
    return 2;
  }
  limit_memory();
  if (count == 3) return read_all(*format, words[2]) < 0;
  return fuzz_format(*format, words[2], std::stoull(words[3]), count > 4 ? std::stoull(words[4]) : 1);
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
