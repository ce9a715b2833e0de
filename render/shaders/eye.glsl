uniform vec3 eye;
uniform vec3 view_forward;  // used instead of the eye where the camera is orthographic
uniform float orthographic;

vec3 toward_eye(vec3 point) { return orthographic > 0.5 ? -view_forward : normalize(eye - point); }
