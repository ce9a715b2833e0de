// What the last word of a command line may become: the words that shells offer.
#pragma once

#include <string>
#include <vector>

namespace hysteron::experiments {

struct Candidate {
  std::string word;
  std::string meaning;  // one line; "": none
};

// `words` are those behind `hysteron`, the last of them begun or "".  Subcommands, options, and the values of
// an option that has a list of them; a "=" may stand in a word or be one, as bash has it.  Nothing where any
// text may stand, as where a file is meant.
std::vector<Candidate> candidates(const std::vector<std::string>& words);

}  // namespace hysteron::experiments
