// How far a point on a flat triangle lies below the round surface that its vertices' normals tell of, along `normal`:
// the mean of its projections on their tangent planes (Boubekeur and Alexa 2008, Eq. 1).  Shadows are looked up from
// there, so that flat triangles throw none on each other (Hanika 2021).
float below_round(vec3 point, vec3 normal) {
  vec3 projected = planes_square * point + vec3(planes_mixed.x * point.y + planes_mixed.y * point.z,
                                                planes_mixed.x * point.x + planes_mixed.z * point.z,
                                                planes_mixed.y * point.x + planes_mixed.z * point.y);
  return dot(facing_planes - projected, normal);
}
