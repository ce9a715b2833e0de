  vec3 world;
  vec3 world_normal;
  vec2 thread;  // warp and weft coordinates [m]
  float field;  // what the colour map shows
  vec4 sky;     // shares of the sky seen from the front and the back side, and of the floor
