#include "sim/device/fibers.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "sim/device/device_counts.h"

namespace hysteron {
namespace {

TEST(Fibers, TakeTurnsBetweenWaits) {
  Fibers fibers;
  std::string order;
  int waits = 0;
  fibers.run(
      3,
      [&](int i) {
        for (int turn = 0; turn < 2; ++turn) {
          EXPECT_EQ(fibers.current(), i);
          order += static_cast<char>('a' + i);
          if (turn == 0) fibers.wait();
        }
      },
      [&] {
        order += '|';
        ++waits;
      });
  EXPECT_EQ(order, "abc|abc|");
  EXPECT_EQ(waits, 2);
  EXPECT_EQ(fibers.current(), -1);
}

// Down to a depth of 4 MB, with a turn of the others at the bottom.
int descend(Fibers& fibers, int depth) {
  constexpr int kFrame = 4096;
  volatile char frame[kFrame];
  for (int k = 0; k < kFrame; k += 64) frame[k] = static_cast<char>(depth);
  if (depth == 0)
    fibers.wait();
  else
    descend(fibers, depth - 1);
  int wrong = 0;
  for (int k = 0; k < kFrame; k += 64) wrong += frame[k] != static_cast<char>(depth);
  return wrong;
}

TEST(Fibers, HaveStacksDeepEnoughForWholeRuns) {
  constexpr int kDepth = 1024;
  Fibers fibers;
  int wrong = 0;
  fibers.run(
      3, [&](int i) { wrong += descend(fibers, kDepth - i); }, [] {});
  EXPECT_EQ(wrong, 0);
}

TEST(Fibers, OneThatEndsEarlyLeavesTheOthersTheirTurns) {
  Fibers fibers;
  std::string order;
  fibers.run(
      3,
      [&](int i) {
        for (int turn = 0; turn < i; ++turn) fibers.wait();
        order += static_cast<char>('a' + i);
      },
      [] {});
  EXPECT_EQ(order, "abc");
}

TEST(Fibers, HandleExceptionsOfTheirOwnWhileOthersRun) {
  Fibers fibers;
  std::string caught(4, ' ');
  fibers.run(
      4,
      [&](int i) {
        try {
          throw std::runtime_error(std::string(1, static_cast<char>('a' + i)));
        } catch (const std::runtime_error&) {
          fibers.wait();  // the next one throws while this one is handled
          try {
            throw;
          } catch (const std::runtime_error& error) {
            caught[i] = error.what()[0];
          }
        }
      },
      [] {});
  EXPECT_EQ(caught, "abcd");
}

TEST(Fibers, ThrowWhatTheFirstHasThrownWhenAllHaveEnded) {
  Fibers fibers;
  int ended = 0;
  const auto job = [&](int i) {
    if (i == 1) throw std::runtime_error("of b");
    fibers.wait();
    if (i == 2) throw std::runtime_error("of c");
    ++ended;
  };
  try {
    fibers.run(4, job, [] {});
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "of b");
  }
  EXPECT_EQ(ended, 2);
}

TEST(Fibers, AFailureOfTheirWaitEndsThoseThatWait) {
  Fibers fibers;
  int woken = 0;
  const auto job = [&](int) {
    fibers.wait();
    ++woken;
  };
  EXPECT_THROW(fibers.run(2, job, [] { throw std::runtime_error("device lost"); }), std::runtime_error);
  EXPECT_EQ(woken, 0);
}

TEST(Fibers, CountWorkOfDevicesEachForItself) {
  Fibers fibers;
  const long before = device_counts.loops;
  long counted[2] = {};
  fibers.run(
      2,
      [&](int i) {
        device_counts.loops += 1 + i;
        fibers.wait();
        device_counts.loops += 10;
        counted[i] = device_counts.loops;
      },
      [] {});
  EXPECT_EQ(counted[0], 11);
  EXPECT_EQ(counted[1], 12);
  EXPECT_EQ(device_counts.loops, before);
}

}  // namespace
}  // namespace hysteron
