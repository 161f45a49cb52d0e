#include "spincat/parallel/task_queue.h"

#include <gtest/gtest.h>

namespace {

using spincat::TaskQueue;
using Time = TaskQueue::Time;
using Seconds = TaskQueue::Seconds;

const Time kStart{};
const Seconds kPatience(5.0);

Time after(double seconds) {
  return kStart + std::chrono::duration_cast<Time::duration>(Seconds(seconds));
}

TEST(TaskQueue, HandsOutInOrderUpToTheWindow) {
  TaskQueue board(5, 3);
  EXPECT_EQ(board.next_for(1, kStart, kPatience), 0U);
  EXPECT_EQ(board.next_for(2, kStart, kPatience), 1U);
  EXPECT_EQ(board.next_for(1, kStart, kPatience), 2U);
  EXPECT_EQ(board.next_for(1, kStart, kPatience), std::nullopt);
  EXPECT_TRUE(board.finish(0));
  EXPECT_EQ(board.next_for(1, kStart, kPatience), std::nullopt);  // not delivered yet
  board.deliver();
  EXPECT_EQ(board.next_for(1, kStart, kPatience), 3U);
}

TEST(TaskQueue, TasksOfALostRankComeFirst) {
  TaskQueue board(4, 10);
  board.next_for(1, kStart, kPatience);
  board.next_for(2, kStart, kPatience);
  EXPECT_EQ(board.take_back(1), 1U);
  EXPECT_EQ(board.take_back(1), 0U);  // it has none any more
  EXPECT_EQ(board.next_for(2, kStart, kPatience), 0U);
  EXPECT_EQ(board.next_for(2, kStart, kPatience), 2U);
}

TEST(TaskQueue, TheFirstResultCounts) {
  TaskQueue board(1, 10);
  board.next_for(1, kStart, kPatience);
  board.take_back(1);
  board.next_for(2, kStart, kPatience);
  EXPECT_TRUE(board.finish(0));  // it was not lost after all
  EXPECT_FALSE(board.finish(0));
  board.deliver();
  EXPECT_TRUE(board.all_delivered());
}

TEST(TaskQueue, ATaskThatWasTakenBackAndCameIsNotDoneAgain) {
  TaskQueue board(1, 10);
  board.next_for(1, kStart, kPatience);
  board.take_back(1);
  EXPECT_TRUE(board.finish(0));
  EXPECT_EQ(board.next_for(2, kStart, kPatience), std::nullopt);
}

TEST(TaskQueue, AtTheEndSlowTasksAreDoneTwiceByOthers) {
  TaskQueue board(1, 10);
  board.next_for(1, kStart, kPatience);
  EXPECT_EQ(board.next_for(2, after(4.9), kPatience), std::nullopt);
  EXPECT_EQ(board.next_for(1, after(5.1), kPatience), std::nullopt);  // not by the same rank
  EXPECT_EQ(board.next_for(2, after(5.1), kPatience), 0U);
  EXPECT_EQ(board.next_for(3, after(99), kPatience), std::nullopt);  // twice is enough
  EXPECT_EQ(board.take_back(1), 0U);                                 // the other one is at it
  EXPECT_EQ(board.take_back(2), 1U);
}

TEST(TaskQueue, PassesOverWhatIsDoneAlready) {
  TaskQueue board(3, 10);
  board.finish(0);
  board.finish(1);
  EXPECT_EQ(board.next_for(1, kStart, kPatience), 2U);
}

}  // namespace
