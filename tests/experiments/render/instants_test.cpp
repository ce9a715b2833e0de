// Which files of several sequences stand beside each other.
#include "experiments/render/instants.h"

#include <gtest/gtest.h>

namespace hysteron::experiments {
namespace {

using Indices = std::vector<std::int64_t>;
using Files = std::vector<int>;

TimedSequence numbered(const std::string& name, const Indices& numbers, double fps) {
  TimedSequence sequence;
  sequence.name = name;
  sequence.fps = fps;
  sequence.number = numbers;
  for (const std::int64_t n : numbers) sequence.files.emplace_back(name + std::to_string(n) + ".obj");
  return sequence;
}

// Calls both functions, with as many instants as there are.
void choose(TimedSequence& a, TimedSequence& b) {
  number_frames({&a, &b});
  choose_instants({&a, &b}, 100);
}

TEST(Instants, PairEqualNumbersWhereFilesAreMissing) {
  TimedSequence a = numbered("a", {0, 1, 2, 3, 4, 5, 6, 7}, 10), gap = numbered("gap", {0, 1, 5, 6}, 10);
  choose(a, gap);
  EXPECT_EQ(a.shown, (Files{0, 1, 5, 6}));
  EXPECT_EQ(gap.shown, (Files{0, 1, 2, 3}));
}

TEST(Instants, PairEqualTimesWhereRatesDiffer) {
  // At 10 and 20 frames per second the second one's files 0 and 4 are 0 and 0.2 s; 0.1 s is missing.
  TimedSequence slow = numbered("slow", {0, 1, 2}, 10), fast = numbered("fast", {0, 1, 4, 5}, 20);
  choose(slow, fast);
  EXPECT_EQ(slow.shown, (Files{0, 2}));
  EXPECT_EQ(fast.shown, (Files{0, 2}));
  // The files of the slower one decide, whichever lasts shorter.
  TimedSequence brief = numbered("brief", {0, 1, 2}, 20), lasting = numbered("lasting", {0, 1, 2, 3}, 10);
  choose(brief, lasting);
  EXPECT_EQ(brief.shown, (Files{0, 2}));
  EXPECT_EQ(lasting.shown, (Files{0, 1}));
}

TEST(Instants, CountFromTheCommonFirstNumberInStepsOfTheFiles) {
  TimedSequence a = numbered("a", {1, 11, 21}, 0), b = numbered("b", {1, 21}, 0);
  choose(a, b);
  EXPECT_EQ(a.frame, (Indices{0, 1, 2}));
  EXPECT_EQ(b.frame, (Indices{0, 2}));
  EXPECT_EQ(a.shown, (Files{0, 2}));
}

TEST(Instants, OfSequencesThatBeginDifferentlyAreWarnedOf) {
  TimedSequence a = numbered("a", {0, 1, 2}, 10), b = numbered("b", {1, 2, 3}, 10);
  choose(a, b);
  EXPECT_EQ(a.shown, (Files{1, 2}));
  EXPECT_EQ(b.shown, (Files{0, 1}));
  EXPECT_EQ(
      frame_warnings({&a, &b}),
      (std::vector<std::string>{
          "the sequences begin at different numbers, a with 0 and b with 1: frames beside each other have "
          "the same number, and number 0 is t = 0"}));
}

TEST(Instants, GoByTheOrderOfFilesWhereNamesTellNoNumbers) {
  TimedSequence a = numbered("a", {0, 5}, 10), b = numbered("b", {0, 1}, 10);
  b.number.clear();
  choose(a, b);
  EXPECT_EQ(a.shown, (Files{0, 1}));
  EXPECT_EQ(frame_warnings({&a, &b}).size(), 1u);
}

TEST(Instants, OfASequenceAloneWithoutNumbersAreWarnedOf) {
  TimedSequence alone = numbered("alone", {0, 1, 5}, 10);
  alone.number.clear();
  alone.unnumbered = "rest.obj is not named like f0.obj";
  number_frames({&alone});
  EXPECT_EQ(
      frame_warnings({&alone}),
      (std::vector<std::string>{
          "the names of the files of alone tell no numbers (rest.obj is not named like f0.obj): frames are "
          "counted in the order of the files"}));
}

// If every other file of 0 to 6 is missing, the remaining ones would play twice as fast without a message.
TEST(Instants, OfNumbersInStepsOfMoreThanOneAreWarnedOf) {
  TimedSequence halved = numbered("halved", {0, 2, 4, 6}, 10), late = numbered("late", {5, 6, 7}, 10);
  number_frames({&halved});
  EXPECT_EQ(halved.frame, (Indices{0, 1, 2, 3}));
  EXPECT_EQ(
      frame_warnings({&halved}),
      (std::vector<std::string>{
          "the numbers of the files of halved go in steps of 2, which are taken as frames that are 0.1 s "
          "apart (--fps 10); if files between them are missing, give --fps 5"}));
  number_frames({&late});
  EXPECT_EQ(frame_warnings({&late}),
            (std::vector<std::string>{
                "the sequence late begins with late5.obj, whose number is 5: t = 0 is that file"}));
}

TEST(Instants, OfSeveralFilesKeepTheirGapsBesideASingleFile) {
  TimedSequence gap = numbered("gap", {3, 4, 9}, 10), single = numbered("single", {0}, 10);
  single.number.clear();
  choose(gap, single);
  EXPECT_EQ(gap.frame, (Indices{0, 1, 6}));
  EXPECT_EQ(gap.shown, (Files{0}));
  EXPECT_EQ(single.shown, (Files{0}));
}

// The last meshes of two runs are at no common time that their files tell.
TEST(Instants, OfSingleFilesHaveNoTime) {
  TimedSequence a = numbered("a", {20}, 10), b = numbered("b", {35}, 10);
  choose(a, b);
  EXPECT_EQ(a.fps, 0);
  EXPECT_EQ(b.fps, 0);
  EXPECT_EQ(a.shown, (Files{0}));
  TimedSequence film = numbered("film", {0, 1}, 10), single = numbered("single", {7}, 10);
  choose(film, single);
  EXPECT_EQ(film.fps, 10);
}

}  // namespace
}  // namespace hysteron::experiments
