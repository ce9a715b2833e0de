#include "experiments/workbench/compare/variants.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/fnv1a.h"
#include "sim/base/number_in.h"
#include "sim/scene/assets.h"

namespace hysteron::experiments {
namespace {

// Returns the key that the flag sets; for parameters a single one.
std::string flag_key(const Flag& flag) {
  if (flag.path == "param") return "param." + flag.text().substr(0, flag.text().find('='));
  return flag_of_key(flag.path);
}

bool is_list(const Flag& flag) {
  return simulation_traits(flag.path).in_columns == InColumns::list &&
         (flag.text() == "all" || flag.text().find_first_of(",+") != std::string::npos);
}

// Returns the names in the last flag of that key, `all` being `every`; one empty name without the flag.
std::vector<std::string> names_in(const CommandLine& line, const std::string& key,
                                  const std::vector<std::string>& every) {
  std::string text;
  for (const Flag& flag : line.flags)
    if (flag_key(flag) == key) text = flag.text();
  if (text.empty()) return {""};
  return text == "all" ? every : split(text);
}

// Adds flags of that experiment: "linear" is --law linear; "linear+fabric.damping=1e-3" adds
// --fabric.damping 1e-3.
void add_flags(std::vector<Flag>& flags, const std::string& experiment, const std::string& path,
               const std::string& text) {
  std::istringstream parts(text);
  std::string part;
  std::getline(parts, part, '+');
  flags.push_back(parsed_flag(experiment, path, part));
  while (std::getline(parts, part, '+')) {
    const std::size_t equals = part.find('=');
    if (equals == part.npos)
      throw Error::invalid_input(text + ": \"" + part + "\" must be key=value").with_key(path, text);
    flags.push_back(parsed_flag(experiment, part.substr(0, equals), part.substr(equals + 1)));
  }
}

// Combines each variant with each of the names, which become part of its own name if there are several.
std::vector<Variant> multiplied(const std::vector<Variant>& variants, const std::string& experiment,
                                const std::string& path, const std::vector<std::string>& names) {
  std::vector<Variant> result;
  for (const Variant& variant : variants)
    for (const std::string& name : names) {
      Variant one = variant;
      if (names.size() > 1 && name.empty())
        throw Error::invalid_input(path + " has a comma without a name before it (--" + path + ")")
            .with_key(path, "");
      if (names.size() > 1) one.name += (one.name.empty() ? "" : "-") + column_name(name);
      if (!name.empty()) add_flags(one.flags, experiment, path, name);
      result.push_back(std::move(one));
    }
  return result;
}

// Makes the names of folders distinct: those of files with equal stems are numbered.
void name_apart(std::vector<Variant>& variants) {
  std::set<std::string> taken;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    std::string& name = variants[i].name;
    name = folder_name(name);
    for (std::size_t j = 0; j < i; ++j)
      if (variants[i].flags == variants[j].flags)
        throw Error::invalid_input(name + " is named twice: columns must differ");
    const std::string stem = name;
    for (int number = 2; !taken.insert(name).second; ++number) name = stem + "-" + std::to_string(number);
  }
}

}  // namespace

std::vector<Flag> override_flags(std::vector<Flag> flags, const std::vector<Flag>& later) {
  std::erase_if(flags, [&](const Flag& flag) {
    return std::any_of(later.begin(), later.end(),
                       [&](const Flag& own) { return flag_key(own) == flag_key(flag); });
  });
  flags.insert(flags.end(), later.begin(), later.end());
  return flags;
}

std::vector<Variant> named_variants(const CommandLine& line) {
  const std::vector<std::string> every_law = law_names();
  std::vector<Variant> variants = {{"", {}}};
  const std::pair<const char*, std::vector<std::string>> keys[] = {
      {"fabric", list_assets("fabrics")},
      {"law", every_law},
      {"integrator", {"semi-implicit", "implicit", "bdf2"}}};
  for (const auto& [key, every] : keys)
    variants = multiplied(variants, line.experiment, key, names_in(line, key, every));
  if (variants.size() == 1 && last_text(line.flags, "law", "") != "")
    variants[0].name = column_name(names_in(line, "law", every_law)[0]);
  name_apart(variants);
  return variants;
}

std::string column_name(const std::string& text) {
  std::istringstream parts(text);
  std::string name;
  for (std::string part; std::getline(parts, part, '+');) {
    const std::size_t value = part.find('=') + 1;  // 0 if there is none
    const std::filesystem::path file = part.substr(value);
    const bool is_file = file.has_parent_path() || file.extension() == ".toml";
    name += (name.empty() ? "" : "+") + part.substr(0, value) + (is_file ? file.stem() : file).string();
  }
  return name.empty() || name.front() == '.' ? "column" + name : name;
}

// File systems allow 255 bytes; files beside the folder, a number or a tuned key may add some.
std::string folder_name(const std::string& name) {
  constexpr std::size_t kLongest = 180;  // [bytes]
  if (name.size() <= kLongest) return name;
  const std::string hash = fmt::format("-{:016x}", fnv1a(name.data(), name.size()));
  std::size_t end = kLongest - hash.size();
  const auto is_inside_a_letter = [&](std::size_t at) {  // in UTF-8
    return (static_cast<unsigned char>(name[at]) & 0xc0) == 0x80;
  };
  while (end > 0 && is_inside_a_letter(end)) --end;
  return name.substr(0, end) + hash;
}

std::string varied_key(const std::vector<Variant>& variants) {
  std::map<std::string, std::set<std::string>> texts;
  for (const Variant& variant : variants)
    for (const Flag& flag : variant.flags) texts[flag_key(flag)];
  for (auto& [key, known] : texts)
    for (const Variant& variant : variants) {
      std::string own;
      for (const Flag& flag : variant.flags)
        if (flag_key(flag) == key) own = flag.text();
      known.insert(own);
    }
  std::erase_if(texts, [](const auto& text) { return text.second.size() < 2; });
  return texts.size() == 1 ? texts.begin()->first : "column";
}

CommandLine with_variant(CommandLine line, const Variant& variant) {
  line.flags = override_flags(line.flags, variant.flags);
  return line;
}

CommandLine without_lists(const CommandLine& line) {
  CommandLine one = line;
  for (const Flag& flag : line.flags)
    if (is_list(flag)) one.listed.push_back(flag_key(flag));
  std::erase_if(one.flags, is_list);
  return one;
}

bool lists_fabrics(const CommandLine& line) {
  return std::any_of(line.flags.begin(), line.flags.end(),
                     [](const Flag& flag) { return flag_key(flag) == "fabric" && is_list(flag); });
}

std::vector<Flag> for_sheets(const CommandLine& line) {
  std::vector<Flag> flags = {{"plain", true}};
  if (last_text(line.flags, "look", "cloth").starts_with("cloth") &&
      last_text(line.flags, "background", "").empty())
    flags.push_back({"background", "white"});
  return flags;
}

}  // namespace hysteron::experiments
