#include "realtime/pipeline/search_deadline.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/realtime/executor/fake_clock.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using Step = SearchBudget::Step;

class SearchDeadlineTest : public testing::Test {
 protected:
  // One search: ranks as many as it may of `starts`, then follows as many as it may of four.
  struct Tried {
    int ranked = 0;
    int followed = 0;
    bool cut = false;
  };
  Tried search(std::chrono::nanoseconds left, std::chrono::nanoseconds rank,
               std::chrono::nanoseconds follow, int starts = 34) {
    Tried tried;
    deadline_at_ = clock_.now() + left;
    deadline_.begin(deadline_at_);
    while (tried.ranked < starts && deadline_.allows(Step::kRank)) {
      clock_.advance(rank);
      ++tried.ranked;
    }
    while (tried.followed < std::min(4, tried.ranked) && deadline_.allows(Step::kFollow)) {
      clock_.advance(follow);
      ++tried.followed;
    }
    tried.cut = deadline_.end();
    return tried;
  }
  bool in_time() { return clock_.now() <= deadline_at_; }

  FakeClock clock_;
  SearchDeadline deadline_{clock_, {.rank = 500us, .follow = 8ms, .memory = 0.9}};
  HostTime deadline_at_;
};

TEST_F(SearchDeadlineTest, AllowsAllThatThereIsTimeFor) {
  const Tried tried = search(33ms, 200us, 3ms);
  EXPECT_EQ(tried.ranked, 34);
  EXPECT_EQ(tried.followed, 4);
  EXPECT_FALSE(tried.cut);
}

TEST_F(SearchDeadlineTest, BeginsNothingThatWouldNotEndInTime) {
  const Tried tried = search(20ms, 200us, 8ms);
  EXPECT_EQ(tried.followed, 1) << "a second one would end too late";
  EXPECT_TRUE(tried.cut);
  EXPECT_TRUE(in_time());
}

TEST_F(SearchDeadlineTest, RanksNoMoreThanLeavesTimeToFollowOne) {
  const Tried tried = search(10ms, 500us, 8ms);
  EXPECT_EQ(tried.ranked, 4);
  EXPECT_EQ(tried.followed, 1);
  EXPECT_TRUE(in_time());
}

TEST_F(SearchDeadlineTest, RefusesAtOnceWhereNoStartCouldBeFollowed) {
  for (const auto left : {8ms, 0ms, -5ms}) {
    const Tried tried = search(left, 500us, 8ms);
    EXPECT_EQ(tried.ranked + tried.followed, 0);
    EXPECT_TRUE(tried.cut);
  }
}

TEST_F(SearchDeadlineTest, KnowsAfterOneStepThatItTakesLongerThanExpected) {
  const Tried slow = search(40ms, 100us, 15ms);
  EXPECT_EQ(slow.followed, 2) << "after 34 starts and one followed there is time for one more";
  EXPECT_TRUE(in_time());
  EXPECT_EQ(search(14ms, 100us, 15ms).ranked, 0) << "and it remembers";
}

TEST_F(SearchDeadlineTest, ForgetsAStepThatOnceTookVeryLong) {
  search(33ms, 100us, 300ms);  // the machine stood still meanwhile
  EXPECT_EQ(search(33ms, 100us, 3ms).followed, 0);
  int searches = 0;
  while (search(33ms, 100us, 3ms).followed == 0) {
    ASSERT_LT(++searches, 100);
  }
  EXPECT_GT(searches, 5) << "but not at once";
}

TEST_F(SearchDeadlineTest, IsNotCutWhereNothingWasLookedFor) {
  deadline_.begin(clock_.now() - 1ms);
  EXPECT_FALSE(deadline_.end());
}

}  // namespace
}  // namespace sparsight
