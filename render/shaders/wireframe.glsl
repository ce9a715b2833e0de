// The mesh's edges over its surface.
uniform samplerBuffer position;
uniform isamplerBuffer corner_index;

vec3 vertex(int corner) {
  int v = 3 * texelFetch(corner_index, 3 * gl_PrimitiveID + corner).r;
  return vec3(texelFetch(position, v).r, texelFetch(position, v + 1).r, texelFetch(position, v + 2).r);
}

float distance_to_line(vec3 p, vec3 a, vec3 b) { return length(cross(p - a, b - a)) / length(b - a); }

// Coverage of the nearest edge by a line 1.1 pixels wide; thinner where edges are closer than a few pixels.
float edge_coverage() {
  vec3 a = vertex(0), b = vertex(1), c = vertex(2);
  float nearest = min(distance_to_line(world, a, b), min(distance_to_line(world, b, c), distance_to_line(world, c, a)));
  float pixel = max(length(dFdx(world)), length(dFdy(world)));
  float height = length(cross(b - a, c - a)) / max(length(b - a), max(length(c - b), length(a - c)));
  float strength = clamp(height / (4.0 * pixel), 0.25, 1.0);
  return strength * (1.0 - smoothstep(0.25, 1.05, nearest / pixel));
}
