// Whether a pixel's light is needed: where the surface is not hidden by cloth, and in further passes where the first
// was uneven.  Software renderers light what fails the test of depth, too, where pixels have several samples.
uniform sampler2D cloth_depth;  // at the middles of pixels
uniform sampler2D uneven;
uniform float first_pass;

const float kDepthStep = 1e-6;

bool is_needed() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(cloth_depth, 0) - 1;
  float far = texelFetch(cloth_depth, at, 0).r;
  for (int i = 0; i < 4; ++i) {
    ivec2 beside = at + ivec2(i % 2 * 2 - 1, i / 2 * 2 - 1);
    far = max(far, texelFetch(cloth_depth, clamp(beside, ivec2(0), last), 0).r);
  }
  return gl_FragCoord.z <= far + kDepthStep && (first_pass > 0.5 || texelFetch(uneven, at, 0).r > 0.5);
}
