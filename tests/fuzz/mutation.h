// Files that are almost right.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace hysteron::fuzz {

// Makes the same files for the same number, on every machine.
class Mutation {
 public:
  // `words`: what the format writes, and what a careless or hostile hand might.
  Mutation(std::uint64_t number, const std::vector<std::string>& words) : random_(number), words_(words) {}

  // One of the seeds, changed in up to eight places.
  std::string of(const std::vector<std::string>& seeds);

 private:
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }
  void change(std::string& text, const std::vector<std::string>& seeds);
  std::string word();
  std::string noise();

  std::mt19937_64 random_;
  const std::vector<std::string>& words_;
};

}  // namespace hysteron::fuzz
