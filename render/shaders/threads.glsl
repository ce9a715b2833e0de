// The normal with the threads' relief.  Not of unit length: what is linear in it keeps its mean over many threads.
vec3 with_threads(vec3 normal, vec2 tilt) {
  // Warp and weft directions on the surface, from how the coordinates change across the screen.
  vec3 px = dFdx(world), py = dFdy(world);
  vec2 tx = dFdx(thread), ty = dFdy(thread);
  float turn = tx.x * ty.y - ty.x * tx.y;
  vec3 warp = (px * ty.y - py * tx.y) * sign(turn), weft = (py * tx.x - px * ty.x) * sign(turn);
  float size = max(length(warp), length(weft));
  return size > 0.0 ? normal - (tilt.x * warp + tilt.y * weft) / size : normal;
}
