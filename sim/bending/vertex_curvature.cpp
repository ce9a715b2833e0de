#include "sim/bending/vertex_curvature.h"

#include <cmath>

#include "sim/base/root_mean_square.h"
#include "sim/bending/curvature_operator.h"

namespace hysteron {

std::vector<double> element_areas(const ClothMesh& mesh, int dimension) {
  if (dimension == 3) return mesh.face_area;
  std::vector<double> area;
  for (int e = 0; e < mesh.interior_edges; ++e)
    area.push_back((mesh.face_area[mesh.edge[e].face0] + mesh.face_area[mesh.edge[e].face1]) / 2);
  return area;
}

double curvature_rms(const std::vector<double>& curvature, const std::vector<double>& area, int dimension) {
  constexpr double kHingesOfFace = 3;
  const double rms = root_mean_square(curvature, area);
  return dimension == 3 ? rms : std::sqrt(kHingesOfFace) * rms;
}

std::vector<float> vertex_average(const ClothMesh& mesh, const std::vector<double>& element, int dimension) {
  std::vector<float> sum(mesh.vertices(), 0), weight(mesh.vertices(), 0);
  const auto add = [&](int vertex, double value, double area) {
    sum[vertex] += static_cast<float>(area * value);
    weight[vertex] += static_cast<float>(area);
  };
  for (std::size_t e = 0; e < element.size(); ++e) {
    if (dimension == 3) {
      for (int k = 0; k < 3; ++k) add(mesh.face[e][k], element[e], mesh.face_area[e]);
    } else {
      const Edge& edge = mesh.edge[e];
      const double area = mesh.face_area[edge.face0] + mesh.face_area[edge.face1];
      for (int vertex : {edge.p2, edge.p3}) add(vertex, element[e], area);
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (weight[i] > 0) sum[i] /= weight[i];
  return sum;
}

std::vector<float> vertex_curvature(const ClothMesh& mesh, const std::vector<double>& element,
                                    int dimension) {
  if (dimension == 1) return vertex_average(mesh, element, 1);
  std::vector<double> trace(element.size() / 3);
  for (std::size_t f = 0; f < trace.size(); ++f) trace[f] = element[3 * f] + element[3 * f + 1];
  return vertex_average(mesh, trace, 3);
}

std::vector<float> surface_curvature(const std::vector<Eigen::Vector3d>& position,
                                     const std::vector<Eigen::Vector3i>& face, const std::string& what) {
  ClothMesh mesh;
  mesh.rest = position;
  mesh.face = face;
  build_topology(mesh, what);
  const CurvatureOperator op = make_shape_operator(mesh, std::vector<char>(position.size()));
  std::vector<double> trace(op.elements());
  for (int f = 0; f < op.elements(); ++f)
    for (int j = op.hinge.start[f]; j < op.hinge.start[f + 1]; ++j)
      trace[f] += (op.coefficient[3 * j] + op.coefficient[3 * j + 1]) * op.rest_angle[op.hinge.item[j]];
  return vertex_average(mesh, trace, 3);
}

}  // namespace hysteron
