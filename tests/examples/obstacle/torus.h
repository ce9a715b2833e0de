// A ring around z: `radius` to the middle of its tube, which is `height` thick.
template <class Real>
HYST_HD inline Distance<Real> torus_distance(const Shape<Real>& s, const Vec3<Real>& p) {
  using std::sqrt;
  const Real r = sqrt(p[0] * p[0] + p[1] * p[1]);
  const Vec3<Real> radial = r > 0 ? Vec3<Real>(p[0] / r, p[1] / r, 0) : Vec3<Real>(1, 0, 0);
  const Vec3<Real> from_middle = p - s.half[0] * radial;
  const Real length = from_middle.norm();
  return {length - s.half[2], length > 0 ? Vec3<Real>(from_middle / length) : radial};
}
