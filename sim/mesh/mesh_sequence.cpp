#include "sim/mesh/mesh_sequence.h"

#include <fmt/core.h>
#include <glob.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "sim/mesh/file_extension.h"

namespace hysteron {
namespace {
namespace fs = std::filesystem;

bool is_mesh(const fs::path& file) {
  return file_extension(file) == ".obj" || file_extension(file) == ".ply";
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Returns the digits from `at` on without leading zeros; moves `at` behind them.
std::string number_at(const std::string& text, std::size_t& at) {
  while (at < text.size() && text[at] == '0') ++at;
  const std::size_t from = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  return text.substr(from, at - from);
}

// Orders frame2 before frame10.
bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string m = number_at(a, i), n = number_at(b, j);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  if ((i < a.size()) != (j < b.size())) return j < b.size();
  return a < b;
}

// Cuts a name into its numbers and the text between them: text, number, text, number, text.
std::vector<std::string> cut_at_numbers(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    const bool in_number = parts.size() % 2 == 0;
    if (is_digit(c) != in_number) parts.emplace_back();
    parts.back() += c;
  }
  return parts;
}

// Returns the place of the only number in which the names differ; none where they differ elsewhere, or in
// several.
std::optional<std::size_t> place_of_number(const std::vector<std::vector<std::string>>& names) {
  std::optional<std::size_t> found;
  for (const auto& parts : names) {
    if (parts.size() != names.front().size()) return {};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i] == names.front()[i] || found == i) continue;
      if (found || i % 2 == 0) return {};
      found = i;
    }
  }
  return found;
}

// A file whose name has other text around its numbers than more than half of the names have, and one of
// those.
struct OddFile {
  std::string name, usual_name;
};

std::optional<OddFile> odd_file(const std::vector<fs::path>& files) {
  const auto text_of = [](const fs::path& file) {
    std::vector<std::string> parts = cut_at_numbers(file.stem().string());
    for (std::size_t i = 1; i < parts.size(); i += 2) parts[i] = "#";
    return parts;
  };
  std::map<std::vector<std::string>, std::vector<fs::path>> alike;
  for (const fs::path& file : files) alike[text_of(file)].push_back(file);
  const auto& [text, usual] =
      *std::ranges::max_element(alike, {}, [](const auto& entry) { return entry.second.size(); });
  if (text.size() == 1 || usual.size() == files.size() || 2 * usual.size() <= files.size()) return {};
  for (const fs::path& file : files)
    if (text_of(file) != text) return OddFile{file.filename().string(), usual.front().filename().string()};
  return {};
}

// Fills in the numbers, or the reason why there are none.
void number_files(MeshSequence& sequence) {
  constexpr std::size_t kMostDigits = 18;  // 64 bits hold no more
  if (sequence.files.size() < 2) return;
  std::vector<std::vector<std::string>> names;
  for (const fs::path& file : sequence.files) names.push_back(cut_at_numbers(file.stem().string()));
  const auto name = [&](std::size_t i) { return sequence.files[i].filename().string(); };
  const auto place = place_of_number(names);
  if (!place) {
    const std::optional<OddFile> odd = odd_file(sequence.files);
    sequence.unnumbered = odd ? odd->name + " is not named like " + odd->usual_name
                              : "their names differ by more than one number";
    return;
  }
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i][*place].size() > kMostDigits) {
      sequence.unnumbered = fmt::format("the number of {} has more than {} digits", name(i), kMostDigits);
      return;
    }
    numbers.push_back(std::stoll(names[i][*place]));
    if (i > 0 && numbers[i] <= numbers[i - 1]) {
      sequence.unnumbered = name(i) + " stands behind " + name(i - 1);
      return;
    }
  }
  sequence.number = numbers;
}

// Refuses a file without a number of its own: frames of a folder are numbered by their names, and it would
// take the numbers from all.
void refuse_odd_file(const fs::path& folder, const std::vector<fs::path>& files) {
  if (const std::optional<OddFile> odd = odd_file(files))
    throw Error::invalid_input(
        "sequence " + folder.string() + ": " + odd->name + " is not named like " + odd->usual_name +
        ", whose number is its frame: take it out of the folder, or name the files one by "
        "one in their order");
}

std::vector<fs::path> meshes_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    if (is_mesh(entry->path()) && !entry->is_directory()) files.push_back(entry->path());
  if (failure) throw unreadable(folder, failure);
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return files;
}

// Returns the last name of a path that may end in "/" or be ".".
std::string sequence_name(const fs::path& path) {
  const fs::path whole = fs::weakly_canonical(path);
  const std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  return name.empty() || name == "/" ? "root" : name;
}

MeshSequence folder_sequence(const fs::path& folder) {
  MeshSequence sequence{sequence_name(folder), meshes_in(folder), {}, {}};
  if (sequence.files.empty() && holds_meshes(folder / "mesh")) sequence.files = meshes_in(folder / "mesh");
  if (sequence.files.empty())
    throw Error::invalid_input("the folder " + folder.string() + " holds no .obj and no .ply");
  refuse_odd_file(folder, sequence.files);
  if (sequence.name == "mesh") sequence.name = sequence_name(fs::weakly_canonical(folder).parent_path());
  return sequence;
}

void check_format(const MeshSequence& sequence) {
  for (const fs::path& file : sequence.files)
    if (file_extension(file) != file_extension(sequence.files.front()))
      throw Error::invalid_input("one sequence of two formats: " + sequence.files.front().string() + " and " +
                                 file.string());
}

void name_files(MeshSequence& sequence) {
  sequence.name = sequence.files.size() == 1
                      ? sequence.files.front().stem().string()
                      : sequence_name(fs::absolute(sequence.files.front()).parent_path());
}

// Makes names distinct, since they name folders in the results.
void tell_apart(std::vector<MeshSequence>& sequences) {
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const std::string name = sequences[i].name;
    const auto taken = [&] {
      return std::any_of(sequences.begin(), sequences.begin() + static_cast<std::ptrdiff_t>(i),
                         [&](const MeshSequence& s) { return s.name == sequences[i].name; });
    };
    for (int number = 2; taken(); ++number) sequences[i].name = name + "-" + std::to_string(number);
  }
}

// Returns the area of all triangles, and texture_area() that of their images in the texture.
double surface_area(const Surface& surface) {
  double area = 0;
  for (const Eigen::Vector3i& f : surface.face)
    area += (surface.vertex[f[1]] - surface.vertex[f[0]])
                .cross(surface.vertex[f[2]] - surface.vertex[f[0]])
                .norm() /
            2;
  return area;
}

double texture_area(const Surface& surface) {
  double area = 0;
  for (const Eigen::Vector3i& f : surface.face) {
    const Eigen::Vector2d u = surface.pattern[f[1]] - surface.pattern[f[0]],
                          v = surface.pattern[f[2]] - surface.pattern[f[0]];
    area += std::abs(u.x() * v.y() - u.y() * v.x()) / 2;
  }
  return area;
}

// Cloth stretches by less: texture coordinates within this factor of its lengths are taken as lengths.
constexpr double kStretch = 1.25;

double texture_scale(const Surface& surface) {
  const double scale = std::sqrt(surface_area(surface) / texture_area(surface));
  if (!std::isfinite(scale) || (scale < kStretch && scale > 1 / kStretch)) return 1;
  return scale;
}

}  // namespace

bool holds_meshes(const fs::path& folder) { return fs::is_directory(folder) && !meshes_in(folder).empty(); }

std::vector<MeshSequence> mesh_sequences(const std::vector<std::string>& words) {
  std::vector<MeshSequence> sequences;
  std::ptrdiff_t loose = -1;  // index of the sequence of single files
  for (const std::string& word : words) {
    const fs::path path(word);
    check_there(path);
    if (fs::is_directory(path)) {
      sequences.push_back(folder_sequence(path));
      continue;
    }
    if (!is_mesh(path)) throw Error::invalid_input("mesh " + word + ": its name must end in .obj or .ply");
    if (loose < 0) {
      loose = static_cast<std::ptrdiff_t>(sequences.size());
      sequences.emplace_back();
    }
    sequences[loose].files.push_back(path);
  }
  if (loose >= 0) name_files(sequences[loose]);
  for (MeshSequence& sequence : sequences) {
    check_format(sequence);
    number_files(sequence);
  }
  tell_apart(sequences);
  return sequences;
}

std::vector<fs::path> files_like(const std::string& pattern) {
  std::error_code ignored;
  if (fs::is_regular_file(pattern, ignored)) return {pattern};
  std::vector<fs::path> files;
  glob_t found{};
  if (glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i)
      if (fs::is_regular_file(found.gl_pathv[i], ignored)) files.emplace_back(found.gl_pathv[i]);
  globfree(&found);
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return natural_less(a.string(), b.string()); });
  return files;
}

Surface read_frame(const fs::path& file, const FileAxes& axes) {
  Surface surface = read_surface(file.string());
  for (Eigen::Vector3d& x : surface.vertex) {
    if (axes.y_up) x = {x.x(), -x.z(), x.y()};
    for (double& length : x) length = in_metres(length, axes.unit);
  }
  for (double& k : surface.curvature) k /= in_metres(1, axes.unit);
  return surface;
}

std::vector<float> thread_coordinates(const Surface& surface) {
  std::vector<float> thread;
  thread.reserve(2 * surface.vertex.size());
  if (!surface.pattern.empty()) {
    const double scale = texture_scale(surface);
    for (const Eigen::Vector2d& at : surface.pattern)
      for (int k = 0; k < 2; ++k) thread.push_back(static_cast<float>(scale * at[k]));
    return thread;
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : surface.vertex) box.extend(x);
  int thinnest = 2;
  for (int k : {1, 0})
    if (box.sizes()[k] < box.sizes()[thinnest]) thinnest = k;
  for (const Eigen::Vector3d& x : surface.vertex)
    for (int k = 0; k < 3; ++k)
      if (k != thinnest) thread.push_back(static_cast<float>(x[k]));
  return thread;
}

}  // namespace hysteron
