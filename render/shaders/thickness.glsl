// Half of a sheet's thickness as it is drawn [m]: never so thin that its edge would be lost between pixels.
uniform float sheet_half;  // [m]
uniform float least_half;  // [m], where the clip space's w is 1

float half_thickness(vec3 middle) { return max(sheet_half, least_half * (view_projection * vec4(middle, 1)).w); }
