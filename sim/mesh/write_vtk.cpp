// Source of the format: VTK File Formats, "XML File Formats" (docs.vtk.org): the data of every array follows
// its own length in bytes, at the offset that its element states.
#include <bit>
#include <cstdint>

#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/mesh/mesh_export.h"

namespace hysteron {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are stored as they lie in memory");

// Writes the elements of a file and the data that follow them.
class Appended {
 public:
  template <class T>
  std::string element(const std::string& type, const std::string& name, int components,
                      const std::vector<T>& values) {
    const std::string result = "<DataArray type=\"" + type + "\" Name=\"" + name +
                               "\" NumberOfComponents=\"" + std::to_string(components) +
                               "\" format=\"appended\" offset=\"" + std::to_string(data_.size()) + "\"/>\n";
    const std::uint64_t bytes = values.size() * sizeof(T);
    append(&bytes, sizeof bytes);
    append(values.data(), bytes);
    return result;
  }
  std::string field(const std::string& file, const VtkField& of, std::size_t places) {
    if (of.values.size() != places * of.components)
      throw Error::invalid_input("cannot write mesh " + file + ": " + std::to_string(of.values.size()) +
                                 " values of " + of.name + ", not " + std::to_string(places * of.components));
    return element("Float64", of.name, of.components, of.values);
  }
  const std::string& data() const { return data_; }

 private:
  void append(const void* from, std::size_t bytes) { data_.append(static_cast<const char*>(from), bytes); }
  std::string data_;
};

std::string polygons(const ClothMesh& mesh, Appended& appended) {
  std::vector<std::int32_t> corners, ends;
  for (const auto& face : mesh.face) {
    for (const int v : face) corners.push_back(v);
    ends.push_back(static_cast<std::int32_t>(corners.size()));
  }
  return "<Polys>\n" + appended.element("Int32", "connectivity", 1, corners) +
         appended.element("Int32", "offsets", 1, ends) + "</Polys>\n";
}

std::string points(const std::vector<Eigen::Vector3d>& position, Appended& appended) {
  std::vector<double> numbers;
  for (const Eigen::Vector3d& x : position) numbers.insert(numbers.end(), x.begin(), x.end());
  return "<Points>\n" + appended.element("Float64", "position", 3, numbers) + "</Points>\n";
}

}  // namespace

void write_vtp(const std::string& file, const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& position,
               const std::vector<VtkField>& of_vertices, const std::vector<VtkField>& of_faces) {
  Appended appended;
  std::string piece = points(position, appended) + polygons(mesh, appended) + "<PointData>\n";
  for (const VtkField& field : of_vertices) piece += appended.field(file, field, position.size());
  piece += "</PointData>\n<CellData>\n";
  for (const VtkField& field : of_faces) piece += appended.field(file, field, mesh.face.size());
  AtomicFile out(file);
  out.stream()
      << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n<PolyData>\n"
      << "<Piece NumberOfPoints=\"" << position.size()
      << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\""
      << mesh.face.size() << "\">\n"
      << piece << "</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  out.stream().write(appended.data().data(), static_cast<std::streamsize>(appended.data().size()));
  out.stream() << "\n</AppendedData>\n</VTKFile>\n";
  out.commit();
}

void write_pvd(const std::string& file, const std::vector<std::pair<double, std::string>>& instants) {
  AtomicFile out(file);
  out.stream() << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                  "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const auto& [time, name] : instants)
    out.stream() << "<DataSet timestep=\"" << number_text(time) << "\" part=\"0\" file=\"" << name
                 << "\"/>\n";
  out.stream() << "</Collection>\n</VTKFile>\n";
  out.commit();
}

}  // namespace hysteron
