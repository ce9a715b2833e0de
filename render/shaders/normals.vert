// Area-weighted vertex normal: half the sum of the cross products of each triangle's two sides at the vertex.
// One vertex a run, captured by transform feedback; the order of the sum is fixed by the adjacency.
uniform samplerBuffer position;       // x, y, z in turn
uniform isamplerBuffer corner_start;  // where a vertex's corners begin
uniform isamplerBuffer corner;        // the other two vertices of each triangle around it, in its sense
out vec3 smooth_normal;

vec3 at(int vertex) {
  return vec3(texelFetch(position, 3 * vertex).r, texelFetch(position, 3 * vertex + 1).r,
              texelFetch(position, 3 * vertex + 2).r);
}

void main() {
  vec3 here = at(gl_VertexID);
  vec3 sum = vec3(0);
  int end = texelFetch(corner_start, gl_VertexID + 1).r;
  for (int i = texelFetch(corner_start, gl_VertexID).r; i < end; ++i) {
    ivec2 others = texelFetch(corner, i).rg;
    sum += cross(at(others.x) - here, at(others.y) - here);
  }
  float size = length(sum);
  smooth_normal = size > 0 ? sum / size : vec3(0, 0, 1);
}
