#include "experiments/workbench/session/interrupts.h"

#include <csignal>
#include <ctime>

namespace hysteron::experiments {
namespace {

volatile std::sig_atomic_t g_seen = 0;
timespec g_when;  // time of the first signal; read by the handler alone

// Counts the living objects, as a batch has many runs at once.
int g_living = 0;
struct sigaction g_interrupt_before, g_terminate_before;

// Handles a signal; it calls only functions that are safe in handlers.
void keep(int signal) {
  constexpr double kOneAndTheSame = 0.5;  // [s]
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (g_seen == 0) {
    g_seen = signal;
    g_when = now;
    return;
  }
  const double since = static_cast<double>(now.tv_sec - g_when.tv_sec) +
                       1e-9 * static_cast<double>(now.tv_nsec - g_when.tv_nsec);
  if (since < kOneAndTheSame) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

Interrupts::Interrupts() {
  if (g_living++ > 0) return;
  g_seen = 0;
  struct sigaction kept {};
  kept.sa_handler = keep;
  kept.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaddset(&kept.sa_mask, signal);  // one after the other
  sigaction(SIGINT, &kept, &g_interrupt_before);
  sigaction(SIGTERM, &kept, &g_terminate_before);
}

Interrupts::~Interrupts() {
  if (--g_living > 0) return;
  sigaction(SIGINT, &g_interrupt_before, nullptr);
  sigaction(SIGTERM, &g_terminate_before, nullptr);
}

std::string Interrupts::seen() {
  if (g_seen == 0) return "";
  return g_seen == SIGINT ? "SIGINT" : "SIGTERM";
}

}  // namespace hysteron::experiments
