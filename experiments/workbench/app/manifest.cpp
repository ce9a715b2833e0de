#include "experiments/workbench/app/manifest.h"

#include <algorithm>

namespace hysteron::experiments {
namespace {

template <class Entries>
auto find(Entries& entries, const std::string& name) {
  return std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.first == name; });
}

}  // namespace

void Metrics::set(const std::string& name, MetricValue value) {
  const auto found = find(entries_, name);
  if (found == entries_.end())
    entries_.emplace_back(name, std::move(value));
  else
    found->second = std::move(value);
}

bool Metrics::contains(const std::string& name) const { return find(entries_, name) != entries_.end(); }

const MetricValue& Metrics::operator[](const std::string& name) const {
  static const MetricValue kUnknown;
  const auto found = find(entries_, name);
  return found == entries_.end() ? kUnknown : found->second;
}

double Metrics::number(const std::string& name) const {
  const MetricValue& value = (*this)[name];
  return value.is_number() ? value.number() : NAN;
}

double Manifest::total_seconds() const {
  const auto found = find(wall_seconds, "total");
  return found == wall_seconds.end() ? 0 : found->second;
}

std::optional<double> Manifest::own_seconds() const {
  return batch ? std::nullopt : std::optional(total_seconds());
}

}  // namespace hysteron::experiments
