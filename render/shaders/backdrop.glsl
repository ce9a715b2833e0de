// A paper backdrop: a gentle gradient upward and a little less light toward the corners.
uniform vec3 backdrop_top, backdrop_bottom;
uniform vec2 picture_size;
uniform vec2 origin;  // of the part that is drawn, in the picture
uniform float vignette;

vec3 backdrop() {
  vec2 p = (gl_FragCoord.xy + origin) / picture_size;
  vec3 paper = mix(backdrop_bottom, backdrop_top, smoothstep(0.05, 1.0, p.y));
  vec2 off = (p - vec2(0.5, 0.45)) * vec2(1.1, 1.0);
  return paper * (1.0 - vignette * dot(off, off));
}
