// SPDX-License-Identifier: BSD-3-Clause
// Parts of long work: what each of them reports of the whole, in whatever order they begin.
#include "Core/Device/DeviceUse.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Parallel/Stages.h"
#include "RecordingContext.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

const SerialExecutor serial;

// All of a part, in several slices.
void run(Progress& part)
{
  constexpr std::int64_t count = 1000;
  part.For(
    count, 1, [](std::int64_t, std::int64_t) {}, 1);
}

struct StagesTest : testing::Test
{
  RecordingContext Recorder{ serial };
  Progress Whole{ this->Recorder.Context() };
};
using PartsTest = StagesTest;
using RoundsTest = StagesTest;

TEST_F(StagesTest, SharesFollowTheWeights)
{
  Stages stages(this->Whole, { { "first", 1.0 }, { "second", 2.5 }, { "third", 1.5 } });
  EXPECT_TRUE(this->Recorder.Reported.empty());
  run(stages["first"]);
  EXPECT_GT(this->Recorder.Reported.size(), 2u);
  EXPECT_LT(this->Recorder.Reported.front(), 0.1);
  this->Recorder.ExpectReported(0.0, 0.2);
  Progress& second = stages["second"];
  second.Expect(8).EndSlice(2);
  this->Recorder.ExpectReported(0.325, 0.325);
  second.EndSlice(6);
  this->Recorder.ExpectReported(0.7, 0.7);
  second.EndSlice(6); // more than was said
  this->Recorder.ExpectReported(0.7, 0.7);
  run(stages["third"]);
  EXPECT_EQ(this->Recorder.Reported.back(), 1.0);
  this->Recorder.ExpectReported(0.7, 1.0);
}

TEST_F(StagesTest, WeightsHaveAnyScale)
{
  for (const double unit : { 1e-12, 0.1, 1e15 })
  {
    RecordingContext recorder(serial);
    Progress whole(recorder.Context());
    Stages stages(whole, { { "first", 3.0 * unit }, { "second", 7.0 * unit } });
    run(stages["first"]);
    recorder.ExpectReported(0.0, 0.3);
    run(stages["second"]);
    EXPECT_EQ(recorder.Reported.back(), 1.0);
  }
}

TEST_F(StagesTest, MayBeSkipped)
{
  Stages stages(this->Whole, { { "first", 1 }, { "second", 2 }, { "third", 1 } });
  run(stages["second"]);
  this->Recorder.ExpectReported(0.25, 0.75);
  run(stages["third"]);
  this->Recorder.ExpectReported(0.75, 1.0);
}

TEST_F(StagesTest, GoOnUntilAnotherBegins)
{
  Stages stages(this->Whole, { { "first", 1 }, { "second", 1 } });
  stages["first"].Expect(4).EndSlice(1);
  this->Recorder.ExpectReported(0.125, 0.125);
  Progress& first = stages["first"];
  first.EndSlice(1);
  this->Recorder.ExpectReported(0.25, 0.25);
  EXPECT_EQ(&stages[std::string("first").c_str()], &first);
  stages["first"].EndSlice(2);
  this->Recorder.ExpectReported(0.5, 0.5);
}

// A stage that begins once more does so from its begin, but nobody hears that.
TEST_F(StagesTest, MayBeRepeated)
{
  Stages stages(this->Whole, { { "first", 1 }, { "second", 1 } });
  run(stages["first"]);
  stages["second"].Expect(2).EndSlice(1);
  this->Recorder.ExpectReported(0.0, 0.75);
  run(stages["first"]);
  this->Recorder.ExpectReported(0.75, 0.75);
  stages["second"].Expect(4).EndSlice(1);
  this->Recorder.ExpectReported(0.75, 0.75);
  stages["second"].EndSlice(3);
  this->Recorder.ExpectReported(1.0, 1.0);
}

TEST_F(StagesTest, NeverTakeTheWholeBack)
{
  this->Whole.Expect(2).EndSlice(1);
  this->Recorder.ExpectReported(0.5, 0.5);
  Stages stages(this->Whole, { { "first", 1 }, { "second", 3 } });
  run(stages["first"]);
  this->Recorder.ExpectReported(0.5, 0.5);
  run(stages["second"]);
  this->Recorder.ExpectReported(0.5, 1.0);
}

TEST_F(StagesTest, RefuseAnUnknownName)
{
  Stages stages(this->Whole, { { "first", 1 }, { "second", 1 } });
  Progress& first = stages["first"];
  first.Expect(2).EndSlice(1);
  try
  {
    stages["third"];
    ADD_FAILURE() << "there is no such stage";
  }
  catch (const std::logic_error& error)
  {
    EXPECT_NE(std::string(error.what()).find("third"), std::string::npos);
  }
  // The stage goes on.
  first.EndSlice(1);
  this->Recorder.ExpectReported(0.25, 0.5);
  EXPECT_THROW(Stages(this->Whole, {})["first"], std::logic_error);
}

TEST_F(StagesTest, MayHaveNoWeight)
{
  Stages stages(this->Whole, { { "nothing", 0 }, { "all", 2 }, { "nothing more", 0 } });
  run(stages["nothing"]);
  this->Recorder.ExpectReported(0.0, 0.0);
  run(stages["all"]);
  this->Recorder.ExpectReported(0.0, 1.0);
  run(stages["nothing more"]);
  EXPECT_EQ(this->Recorder.Reported.front(), 1.0);
  this->Recorder.ExpectReported(1.0, 1.0);
}

// Then nobody knows their shares.
TEST_F(StagesTest, MayAllHaveNoWeight)
{
  Stages stages(this->Whole, { { "first", 0 }, { "second", 0 } });
  stages["first"].Expect(4).EndSlice(1);
  this->Recorder.ExpectReported(0.25, 0.25);
  stages["second"].Expect(4).EndSlice(3);
  this->Recorder.ExpectReported(0.75, 0.75);
}

TEST_F(StagesTest, Nest)
{
  Stages outer(this->Whole, { { "first", 1 }, { "second", 1 } });
  {
    Stages inner(outer["first"], { { "third", 1 }, { "fourth", 3 } });
    run(inner["third"]);
    this->Recorder.ExpectReported(0.0, 0.125);
    Parts parts(inner["fourth"], 3);
    run(parts[0]);
    this->Recorder.ExpectReported(0.125, 0.25);
    Progress innermost{ Context(parts[1]) }; // of a callee that takes a context
    run(innermost);
    this->Recorder.ExpectReported(0.25, 0.375);
    Rounds rounds(parts[2], 1);
    run(rounds.Next());
    this->Recorder.ExpectReported(0.375, 0.4375);
  }
  run(outer["second"]);
  this->Recorder.ExpectReported(0.5, 1.0);
}

TEST_F(StagesTest, HaveWhatTheWholeHas)
{
  const SoloRanks ranks;
  DeviceUse device("none");
  Context context(serial);
  context.Group = &ranks;
  context.Device = &device;
  Progress whole(context);
  Stages stages(whole, { { "only", 1 } });
  Progress& only = stages["only"];
  EXPECT_EQ(&only.Threads(), &serial);
  EXPECT_EQ(&only.Group(), &ranks);
  EXPECT_EQ(only.Device(), &device);
  run(only); // without callbacks
  EXPECT_FALSE(only.ShouldStop());
}

// At all levels, and in stages that begin later.
TEST_F(StagesTest, AreCancelled)
{
  Stages outer(this->Whole, { { "first", 1 }, { "second", 1 } });
  Stages inner(outer["first"], { { "third", 1 }, { "fourth", 1 } });
  this->Recorder.MaximumQueries = 2;
  Progress& third = inner["third"];
  EXPECT_THROW(run(third), Cancelled);
  EXPECT_EQ(this->Recorder.Queries, 3);
  EXPECT_EQ(this->Recorder.Reported.size(), 3u);
  EXPECT_LT(this->Recorder.Reported.back(), 0.25) << "went on after it was cancelled";
  EXPECT_TRUE(third.IsCancelled());
  EXPECT_THROW(inner["fourth"].Check(), Cancelled);
  EXPECT_THROW(outer["second"].Check(), Cancelled);
  EXPECT_THROW(this->Whole.Check(), Cancelled);
}

TEST_F(PartsTest, AreEqual)
{
  Parts parts(this->Whole, 4);
  run(parts[0]);
  this->Recorder.ExpectReported(0.0, 0.25);
  run(parts[2]); // one is skipped
  this->Recorder.ExpectReported(0.5, 0.75);
  run(parts[3]);
  EXPECT_EQ(this->Recorder.Reported.back(), 1.0);
  this->Recorder.ExpectReported(0.75, 1.0);
  run(parts[1]);
  this->Recorder.ExpectReported(1.0, 1.0);
}

TEST_F(PartsTest, SharesFollowTheWeights)
{
  Parts parts(this->Whole, { 1.0, 0.0, 1.5, 2.5 });
  run(parts[0]);
  this->Recorder.ExpectReported(0.0, 0.2);
  run(parts[1]);
  this->Recorder.ExpectReported(0.2, 0.2);
  Progress& third = parts[2];
  third.Expect(2).EndSlice(1);
  this->Recorder.ExpectReported(0.35, 0.35);
  third.EndSlice(1);
  this->Recorder.ExpectReported(0.5, 0.5);
  run(parts[3]);
  EXPECT_EQ(this->Recorder.Reported.back(), 1.0);
  this->Recorder.ExpectReported(0.5, 1.0);
}

TEST_F(PartsTest, MayHaveNoWeight)
{
  Parts parts(this->Whole, std::vector<double>{ 0.0, 0.0 });
  parts[0].Expect(4).EndSlice(1);
  this->Recorder.ExpectReported(0.25, 0.25);
  parts[1].Expect(4).EndSlice(3);
  this->Recorder.ExpectReported(0.75, 0.75);
}

TEST_F(PartsTest, MayBeNone)
{
  const Parts equal(this->Whole, 0);
  const Parts weighted(this->Whole, std::vector<double>());
  EXPECT_TRUE(this->Recorder.Reported.empty());
}

TEST_F(PartsTest, AreCancelled)
{
  Parts parts(this->Whole, 2);
  this->Recorder.MaximumQueries = 0;
  EXPECT_THROW(run(parts[0]), Cancelled);
  EXPECT_THROW(run(parts[1]), Cancelled);
}

// However many rounds there are, each goes on.
TEST_F(RoundsTest, LeadTowardsTheEnd)
{
  Stages stages(this->Whole, { { "before", 1 }, { "rounds", 2 }, { "after", 2 } });
  run(stages["before"]);
  Rounds rounds(stages["rounds"], 4);
  double last = 0.2;
  for (int round = 0; round < 100; ++round)
  {
    run(rounds.Next());
    const double end = this->Recorder.Reported.back();
    this->Recorder.ExpectReported(round == 0 ? 0.0 : last, end);
    EXPECT_GT(end, last + 1e-4);
    EXPECT_LT(end, 0.6);
    last = end;
    if (round == 3)
    {
      EXPECT_NEAR(last, 0.4, 1e-15);
    }
  }
  run(stages["after"]);
  this->Recorder.ExpectReported(0.6, 1.0);
}

TEST_F(RoundsTest, OneMayBeUsual)
{
  Rounds rounds(this->Whole, 1);
  for (const double end : { 1.0 / 2.0, 2.0 / 3.0, 3.0 / 4.0, 4.0 / 5.0 })
  {
    run(rounds.Next());
    this->Recorder.ExpectReported(0.0, end);
  }
}

TEST_F(RoundsTest, AreCancelled)
{
  Rounds rounds(this->Whole, 2);
  run(rounds.Next());
  this->Recorder.MaximumQueries = 0;
  EXPECT_THROW(run(rounds.Next()), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
