#include "sim/base/own_thread.h"

#include <gtest/gtest.h>

#include <latch>
#include <stdexcept>
#include <vector>

namespace hysteron::render {
namespace {

using Ids = std::vector<std::thread::id>;

// Notes the threads that make, use and destroy it.
struct Witness {
  explicit Witness(Ids& seen) : ids(seen) { note(); }
  ~Witness() { note(); }
  void note() const { ids.push_back(std::this_thread::get_id()); }
  Ids& ids;
};

TEST(OwnThread, MakesUsesAndDestroysOnOneThreadOfItsOwn) {
  Ids ids;
  {
    OwnThread<Witness> witness([&] { return std::make_unique<Witness>(ids); });
    witness.run([](const Witness& w) { w.note(); });
    witness.post([](const Witness& w) { w.note(); });
  }
  ASSERT_EQ(ids.size(), 4u);
  EXPECT_EQ(ids, Ids(4, ids[0]));
  EXPECT_NE(ids[0], std::this_thread::get_id());
}

TEST(OwnThread, PostsWithoutWaitingAndWaitsForTheEarlierOne) {
  OwnThread<int> number([] { return std::make_unique<int>(1); });
  std::latch gate(1);
  number.post([&](int& n) {
    gate.wait();  // for ever, had post() waited for this
    n *= 10;
  });
  gate.count_down();
  number.post([](int& n) { n += 2; });
  EXPECT_EQ(number.run([](const int& n) { return n; }), 12);
}

TEST(OwnThread, TellsOnceWhatWentWrong) {
  OwnThread<int> number([] { return std::make_unique<int>(5); });
  number.post([](int&) { throw std::runtime_error("no ink"); });
  EXPECT_THROW(number.wait(), std::runtime_error);
  number.wait();
  EXPECT_THROW(number.run([](int&) { throw std::runtime_error("no paper"); }), std::runtime_error);
  EXPECT_EQ(number.run([](const int& n) { return n; }), 5);
}

TEST(OwnThread, IsNotMadeWhereWhatItOwnsIsNot) {
  const auto make = []() -> std::unique_ptr<int> { throw std::runtime_error("no context"); };
  EXPECT_THROW(OwnThread<int>{make}, std::runtime_error);
}

}  // namespace
}  // namespace hysteron::render
