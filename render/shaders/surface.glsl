  vec3 world;
  vec3 world_normal;
  vec2 thread;  // warp and weft coordinates [m]
  float field;  // what the colour map shows
#ifdef FIGURE
  vec3 facing_planes, planes_square, planes_mixed;  // sums over the tangent planes n.(x - p) = 0: n (n.p), n n^T
#endif
  vec4 sky;     // shares of the sky seen from the front and the back side, and of the floor
