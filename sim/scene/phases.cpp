#include "sim/scene/phases.h"

#include <charconv>

#include "sim/base/error.h"
#include "sim/scene/key_table.h"

namespace hysteron {

double phase_start(const std::vector<Phase>& phases, const std::string& name) {
  double start = 0;
  for (const Phase& phase : phases) {
    if (phase.name == name) return start;
    start += phase.seconds;
  }
  return -1;
}

double phases_end(const std::vector<Phase>& phases) {
  double end = 0;
  for (const Phase& phase : phases) end += phase.seconds;
  return end;
}

double time_of(const std::vector<Phase>& phases, const std::string& text, const std::string& origin) {
  const std::size_t sign = text.find_first_of("+-");
  const std::string name = text.substr(0, text.find_last_not_of(" +-", sign) + 1);
  const double start = phase_start(phases, name);
  if (start < 0) {
    std::vector<std::string> names;
    for (const Phase& phase : phases) names.push_back(phase.name);
    throw Error::request("\"" + text + "\" must be a number of seconds or begin with a phase, " +
                         (names.empty() ? "of which there are none" : join(names, " | ")) + " (" + origin +
                         ")");
  }
  if (sign == std::string::npos) return start;
  const std::size_t digit = text.find_first_not_of(' ', sign + 1);
  double more = 0;
  const char* end = text.data() + text.size();
  const bool digits = digit != std::string::npos;
  if (!digits || std::from_chars(text.data() + digit, end, more).ptr != end)
    throw Error::request("\"" + text + "\": after the phase, + or - and a number of seconds are expected (" +
                         origin + ")");
  return text[sign] == '-' ? start - more : start + more;
}

std::string Scene::phase_at(double time) const {
  std::string name;
  double start = 0;
  for (const Phase& p : phase) {
    if (time < start) break;
    name = p.name;
    start += p.seconds;
  }
  return name;
}

}  // namespace hysteron
