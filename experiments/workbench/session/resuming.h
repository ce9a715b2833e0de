// Checkpoints of a session: what is in them, when they are taken, how a run goes on from one.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "experiments/workbench/session/session.h"

namespace hysteron::experiments {

// The last of the observers: a run that goes on does so when all others have begun.
class Checkpoints : public Observer {
 public:
  // With --resume a run that is complete and was asked for the same is not repeated; one that was asked for
  // something else is, and stderr says what differs.  Of one that is not complete the checkpoint is read.
  // Throws Error::invalid_input for a checkpoint of another request.
  Checkpoints(const CommandLine& line, const Setup& setup, const Cloth& cloth, const Simulation& simulation);

  bool is_complete() const { return is_complete_; }  // the run of --resume
  // Files of the interrupted run; its others are written anew.
  std::vector<std::string> kept_files() const;

  void begin(Session& session) override;  // goes on from the checkpoint
  // Takes one if one is due.  Throws Error::simulation where a signal has asked for the end.
  void step(Session& session) override;
  void finish(Session& session, const std::string& title) override;
  void serialise(Archive& archive) override { archive(resumed_at_); }

 private:
  using Clock = std::chrono::steady_clock;

  void take(Session& session);

  bool is_complete_ = false, is_repeated_ = false;
  std::string state_;                       // to go on from; empty: none, or gone on
  std::vector<double> resumed_at_;          // [s]
  Clock::time_point taken_ = Clock::now();  // or begun
};

}  // namespace hysteron::experiments
