// Finds keys that are set and that nothing in the scene reads, and returns a sentence for each as a run's
// warnings.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/scene/key_table.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// A key of a table, and the condition under which the table reads it.
template <class Table>
struct ReadKey {
  const char* key;
  const char* by;  // the condition in words: "select = box"
  bool (*is_read)(const Table&);
};

// Returns "[[pin]] 2: home = 0.5 changes nothing, select = box alone reads it" for each key that differs from
// its default and that this table does not read.
template <class Table, std::size_t n>
std::vector<std::string> idle_keys_of(const std::vector<Table>& tables, const std::string& name,
                                      Keys (*bind)(Table&), const ReadKey<Table> (&rows)[n]) {
  std::vector<std::string> warnings;
  Table usual;
  const auto usual_keys = to_json(bind(usual));
  for (std::size_t i = 0; i < tables.size(); ++i) {
    Table table = tables[i];
    const auto keys = to_json(bind(table));
    for (const ReadKey<Table>& row : rows)
      if (!row.is_read(table) && keys.at(row.key) != usual_keys.at(row.key))
        warnings.push_back("[[" + name + "]] " + std::to_string(i + 1) + ": " + row.key + " = " +
                           keys.at(row.key).dump() + " changes nothing: " + row.by + " reads it");
  }
  return warnings;
}

// Returns a warning for each of the scene's flags, and of the keys of its pins and obstacles, that nothing
// reads.
std::vector<std::string> idle_key_warnings(const Scene& scene);

}  // namespace hysteron::experiments
