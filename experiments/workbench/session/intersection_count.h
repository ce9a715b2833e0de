// Counts the triangles that pass through each other, at every watched instant of a run.
#pragma once

#include <functional>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "experiments/workbench/session/session.h"
#include "sim/base/archive.h"

namespace hysteron::experiments {

// With a GPU an instant is counted on a separate thread while the next steps run, and reported with the next
// one.
class IntersectionCount : public Observer {
 public:
  // `tell` gets a warning for each instant with intersections, on the caller's thread.
  IntersectionCount(std::vector<Eigen::Vector3i> face, bool behind_a_gpu,
                    std::function<void(const std::string&)> tell)
      : face_(std::move(face)), behind_a_gpu_(behind_a_gpu), tell_(std::move(tell)) {}

  void watch(Session& session, const Snapshot& instant) override;
  void finish(Session& session, const std::string& title) override;
  void see(double time, const std::vector<Eigen::Vector3d>& x);
  // Returns the number of pairs over all instants; waits for the last count.
  long pairs();
  void serialise(Archive& archive) override;

 private:
  struct Found {
    long pairs = 0;
    std::string line;  // empty if there are none
  };
  Found found_in(double time, const std::vector<Eigen::Vector3d>& x) const;
  void take();  // adds the pending count, if there is one
  void add(const Found& found);

  std::vector<Eigen::Vector3i> face_;
  bool behind_a_gpu_;
  std::function<void(const std::string&)> tell_;
  long pairs_ = 0;
  std::future<Found> counting_;  // declared last, as its thread reads the faces
};

}  // namespace hysteron::experiments
