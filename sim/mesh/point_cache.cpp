// Source of the format: Autodesk 3ds Max, Point Cache 2.
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "sim/base/error.h"
#include "sim/mesh/mesh_export.h"

namespace hysteron {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are stored as they lie in memory");

struct Header {
  std::array<char, 12> signature = {'P', 'O', 'I', 'N', 'T', 'C', 'A', 'C', 'H', 'E', '2', '\0'};
  std::int32_t version = 1, points = 0;
  float first_frame = 0, frames_per_sample = 1;
  std::int32_t samples = 0;
};
static_assert(sizeof(Header) == 32);

}  // namespace

void write_to_point_cache(const std::string& file, std::size_t instant,
                          const std::vector<Eigen::Vector3d>& position) {
  using std::ios;
  std::fstream stream(file, ios::binary | ios::out | (instant == 0 ? ios::trunc : ios::in));
  std::vector<float> xyz;
  for (const Eigen::Vector3d& x : position)
    for (const double c : x) xyz.push_back(static_cast<float>(c));
  const std::size_t bytes = xyz.size() * sizeof(float);
  Header header;
  header.points = static_cast<std::int32_t>(position.size());
  header.samples = static_cast<std::int32_t>(instant);
  const auto write_header = [&] {
    stream.seekp(0);
    stream.write(reinterpret_cast<const char*>(&header), sizeof(header));
    stream.flush();
  };
  write_header();
  stream.seekp(static_cast<std::streamoff>(sizeof(header) + instant * bytes));
  stream.write(reinterpret_cast<const char*>(xyz.data()), static_cast<std::streamsize>(bytes));
  stream.flush();
  ++header.samples;
  write_header();
  if (!stream) throw Error::system("cannot write " + file + ": " + std::strerror(errno));
}

std::vector<Eigen::Vector3f> read_from_point_cache(const std::string& file, std::size_t instant) {
  std::ifstream stream(file, std::ios::binary);
  Header header;
  stream.read(reinterpret_cast<char*>(&header), sizeof(header));
  if (!stream) throw Error::system("cannot read " + file + ": " + std::strerror(errno));
  if (header.samples <= 0 || instant >= static_cast<std::size_t>(header.samples))
    throw Error::system("cannot read " + file + ": it has " + std::to_string(header.samples) +
                        " instants and not number " + std::to_string(instant));
  std::vector<Eigen::Vector3f> position(static_cast<std::size_t>(header.points));
  const std::size_t bytes = position.size() * sizeof(Eigen::Vector3f);
  stream.seekg(static_cast<std::streamoff>(sizeof(header) + instant * bytes));
  stream.read(reinterpret_cast<char*>(position.data()), static_cast<std::streamsize>(bytes));
  if (!stream) throw Error::system("cannot read " + file + ": it is cut off");
  return position;
}

}  // namespace hysteron
