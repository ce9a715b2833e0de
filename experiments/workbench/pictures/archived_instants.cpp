#include "experiments/workbench/pictures/archived_instants.h"

#include <algorithm>
#include <cmath>

#include "render/contact_sheet.h"

namespace hysteron::experiments {
namespace {

double distance(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.empty() || a.size() != b.size()) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (1.0 * a[i] - b[i]) * (1.0 * a[i] - b[i]);
  return std::sqrt(3 * sum / static_cast<double>(a.size()));
}

}  // namespace

double ArchivedInstants::add(ArchivedInstant instant) {
  const double since = distance(instant.xyz, last_);
  last_ = instant.xyz;
  moved_.push_back(all_.empty() ? 0 : distance(instant.xyz, all_.back().xyz));
  all_.push_back(std::move(instant));
  if (all_.size() <= kMax) return since;
  const auto least = std::min_element(moved_.begin() + 1, moved_.end() - 1) - moved_.begin();
  all_.erase(all_.begin() + least);
  moved_.erase(moved_.begin() + least);
  moved_[least] = distance(all_[least].xyz, all_[least - 1].xyz);
  return since;
}

std::vector<ArchivedInstant> ArchivedInstants::chosen(int count, double until) const {
  std::vector<double> moved;
  for (std::size_t i = 0; i < all_.size() && all_[i].time <= until; ++i) moved.push_back(moved_[i]);
  std::vector<ArchivedInstant> chosen;
  for (int i : render::spread_by_displacement(moved, count))
    chosen.push_back(all_[static_cast<std::size_t>(i)]);
  return chosen;
}

void ArchivedInstants::serialise(Archive& archive) {
  archive(moved_);
  archive(last_);
  all_.resize(archive.size(all_.size()));
  for (ArchivedInstant& instant : all_) {
    archive(instant.time);
    archive(instant.xyz);
    archive(instant.values);
    archive(instant.caption);
    archive(instant.loop.curvature);
    archive(instant.loop.moment);
  }
}

}  // namespace hysteron::experiments
