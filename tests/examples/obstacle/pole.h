// The pole is all within `radius` of the z axis, without end.
template <class Real>
HYST_HD inline Distance<Real> pole_distance(const Shape<Real>& s, const Vec3<Real>& p) {
  using std::sqrt;
  const Real r = sqrt(p[0] * p[0] + p[1] * p[1]);
  const Vec3<Real> radial = r > 0 ? Vec3<Real>(p[0] / r, p[1] / r, 0) : Vec3<Real>(1, 0, 0);
  return {r - s.half[0], radial};
}
