// Checkpoints of a session: their content, when they are taken, and how a run goes on from one.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "experiments/workbench/session/session.h"

namespace hysteron::experiments {

// This is the last of the observers: a run goes on from its checkpoint when all others have begun.
class Checkpoints : public Observer {
 public:
  // With --resume a complete run of the same request is not repeated; one of another request is, and stderr
  // says what differs.  The checkpoint of an incomplete run is read.  Throws Error::invalid_input for a
  // checkpoint of another request.
  Checkpoints(const CommandLine& line, const Setup& setup, const Cloth& cloth, const Simulation& simulation);

  bool is_complete() const { return is_complete_; }  // true if the run of --resume is complete
  // Returns the files of the interrupted run that are kept; its others are written anew.
  std::vector<std::string> archived_files() const;

  void begin(Session& session) override;  // restores the checkpoint
  // Takes a checkpoint if one is due.  Throws Error::simulation if a signal has asked for the end.
  void step(Session& session) override;
  void finish(Session& session, const std::string& title) override;
  void serialise(Archive& archive) override { archive(resumed_at_); }

 private:
  using Clock = std::chrono::steady_clock;

  void take(Session& session);

  bool is_complete_ = false, is_repeated_ = false;
  std::string state_;                       // state to restore; empty if there is none or it is restored
  std::vector<double> resumed_at_;          // times of earlier restarts [s]
  Clock::time_point taken_ = Clock::now();  // time of the last checkpoint, or of the beginning
};

}  // namespace hysteron::experiments
