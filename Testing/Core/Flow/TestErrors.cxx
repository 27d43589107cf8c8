// SPDX-License-Identifier: BSD-3-Clause
// Densities that cannot be transported, and options out of range: reported, never clamped.
#include "TestFlow.h"
#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace RectifiedTransport
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

// What is found wrong with a density, on several threads or one.
template <int Dimension>
DensitySummary reject(const TestDensity<Dimension>& density, const Executor& executor)
{
  try
  {
    const RectifiedFlow<Dimension> flow(density.Source(), executor);
  }
  catch (const InvalidDensity& error)
  {
    EXPECT_STRNE(error.what(), "");
    return error.Summary();
  }
  ADD_FAILURE() << "the density was accepted";
  return {};
}

TEST(Errors, NotFinite)
{
  TestDensity<2> density = uniformDensity<2>({ 150, 90 });
  density.Values[13001] = NaN;
  density.Values[700] = Infinity;
  density.Values[4000] = -Infinity;
  const DensitySummary serial = reject(density, SerialExecutor());
  EXPECT_EQ(serial.NotFinite, 3);
  EXPECT_EQ(serial.FirstNotFinite, 700);
  EXPECT_EQ(serial.Negative, 0);
  EXPECT_EQ(serial.FirstNegative, -1);
  const DensitySummary parallel = reject(density, OpenMPExecutor());
  EXPECT_EQ(parallel.NotFinite, 3);
  EXPECT_EQ(parallel.FirstNotFinite, 700);
}

TEST(Errors, Negative)
{
  TestDensity<3> density = uniformDensity<3>({ 20, 30, 25 });
  density.Values[14999] = -1e-300;
  density.Values[321] = -2.0;
  const DensitySummary summary = reject(density, OpenMPExecutor());
  EXPECT_EQ(summary.Negative, 2);
  EXPECT_EQ(summary.FirstNegative, 321);
  EXPECT_EQ(summary.NotFinite, 0);
  EXPECT_EQ(summary.FirstNotFinite, -1);
}

TEST(Errors, NegativeZeroIsZero)
{
  TestDensity<1> density = uniformDensity<1>({ 50 });
  density.Values[7] = -0.0;
  EXPECT_EQ(makeFlow(density).Total(), 49.0);
}

TEST(Errors, NoMass)
{
  const DensitySummary summary = reject(uniformDensity<2>({ 31, 17 }, 0.0), OpenMPExecutor());
  EXPECT_EQ(summary.Total, 0.0);
  EXPECT_EQ(summary.Maximum, 0.0);
  EXPECT_EQ(summary.NotFinite, 0);
  EXPECT_EQ(summary.Negative, 0);
}

TEST(Errors, TooMuchMass)
{
  const DensitySummary summary = reject(uniformDensity<2>({ 31, 17 }, 1e307), OpenMPExecutor());
  EXPECT_EQ(summary.Total, Infinity);
  EXPECT_EQ(summary.Maximum, 1e307);
}

// Nobody may read them.
class UnreadValues final : public DensityValues
{
public:
  void Read(std::int64_t, std::int64_t, double*) const override { ADD_FAILURE() << "was read"; }
};

template <int Dimension>
void buildUnread(const GridSize<Dimension>& size)
{
  const UnreadValues values;
  const RectifiedFlow<Dimension> flow(DensitySource<Dimension>{ size, values });
}

TEST(Errors, Size)
{
  EXPECT_THROW(buildUnread<2>({ 0, 5 }), std::invalid_argument);
  EXPECT_THROW(buildUnread<3>({ 4, 5, -1 }), std::invalid_argument);
  EXPECT_THROW(buildUnread<1>({ (std::int64_t{ 1 } << 30) + 1 }), std::invalid_argument);
}

TEST(Errors, MemoryThatCannotBeHad)
{
  const std::int64_t side = std::int64_t{ 1 } << 18;
  EXPECT_THROW(buildUnread<3>({ side, side, side }), std::bad_alloc);
  const std::int64_t huge = std::int64_t{ 1 } << 30;
  EXPECT_THROW(buildUnread<3>({ huge, huge, huge }), std::bad_alloc);
}

// Every call refuses the options, and its message holds the value.
void expectRefused(const FlowOptions& options, const std::string& value)
{
  const RectifiedFlow<2> flow = makeFlow(uniformDensity<2>({ 8, 8 }));
  Points<2> point{ { 1.0, 1.0 } };
  const std::string messages[] = {
    refusal([&]() { flow.Forward(point, point, options); }),
    refusal([&]() { flow.Backward(point, point, options); }),
    refusal([&]() { flow.ForwardAt(point, { 0.5 }, point, options); }),
  };
  for (const std::string& message : messages)
  {
    EXPECT_NE(message.find(value), std::string::npos) << message;
  }
  EXPECT_EQ(point[0][0], 1.0);
}

TEST(Errors, NumberOfSteps)
{
  for (const Integrator method :
    { Integrator::Multistep, Integrator::RungeKutta4, Integrator::Euler })
  {
    expectRefused(steps(-3, method), "-3");
    expectRefused(steps(10001, method), "10001");
  }
}

TEST(Errors, AreaTolerance)
{
  for (const double tolerance : { 0.0, -0.02, 1.001, NaN, Infinity })
  {
    FlowOptions options;
    options.AreaTolerance = tolerance;
    expectRefused(options, "AreaTolerance is " + std::to_string(tolerance));
  }
}

TEST(Errors, Tolerance)
{
  expectRefused(adaptive(0.0), "0");
  expectRefused(adaptive(-0.25), "-0.25");
  expectRefused(adaptive(NaN), "nan");
  expectRefused(adaptive(Infinity), "inf");
}

// No number of steps makes an error smaller than rounding does: what asks for that gets about what
// the smallest tolerance of use gets, and ends.
template <int Dimension>
void expectTinyTolerancesEnd(const TestDensity<Dimension>& density)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, 64);
  constexpr double most = 20000.0; // evaluations of a particle
  for (const bool backward : { false, true })
  {
    const auto run = [&](double tolerance) {
      Points<Dimension> positions(seeds.size());
      int asked = 0;
      const SerialExecutor serial;
      const Context patient(serial, {}, [&asked]() { return ++asked > 2.0 * most / 64.0; });
      FlowReport report;
      EXPECT_NO_THROW(report = backward
          ? flow.Backward(seeds, positions, adaptive(tolerance), patient)
          : flow.Forward(seeds, positions, adaptive(tolerance), patient))
        << tolerance << " has no end";
      EXPECT_LT(static_cast<double>(report.Evaluations) / 64.0, most) << tolerance;
      return positions;
    };
    const Points<Dimension> fine = run(1e-6);
    for (const double tolerance :
      { 1e-15, 1e-30, 1e-300, 1e-301, std::numeric_limits<double>::denorm_min() })
    {
      EXPECT_LT(largestDistance<Dimension>(run(tolerance), fine), 1e-3) << tolerance;
    }
  }
}

TEST(Errors, TinyTolerancesEnd)
{
  expectTinyTolerancesEnd(twoGaussians<1>({ 300 }));
  expectTinyTolerancesEnd(twoGaussians<2>({ 90, 120 }));
  expectTinyTolerancesEnd(randomCells<2>({ 60, 45 }, 0.2));
  expectTinyTolerancesEnd(twoGaussians<3>({ 20, 26, 31 }));
}

TEST(Errors, Times)
{
  const RectifiedFlow<2> flow = makeFlow(uniformDensity<2>({ 8, 8 }));
  const Points<2> seed{ { 1.0, 1.0 } };
  const auto refused = [&](const std::vector<double>& times) {
    Points<2> path(times.size());
    return refusal([&]() { flow.ForwardAt(seed, times, path); });
  };
  EXPECT_NE(refused({ -0.5, 1.0 }).find("times"), std::string::npos);
  EXPECT_NE(refused({ 0.0, 1.5 }).find("time 1.5"), std::string::npos);
  EXPECT_NE(refused({ NaN }).find("times"), std::string::npos);
  EXPECT_NE(refused({ 0.0, NaN, 1.0 }).find("times"), std::string::npos);
  EXPECT_NE(refused({ 0.75, 0.25 }).find("time 0.250000 is given after 0.75"), std::string::npos);
}

// Positions are as many as points, points at times, or cells of a lattice; nothing is written else.
TEST(Errors, NumbersOfPositions)
{
  const RectifiedFlow<2> flow = makeFlow(uniformDensity<2>({ 8, 8 }));
  const Points<2> seeds(17, Point<2>{ 1.0, 1.0 });
  Points<2> room(60, Point<2>{ -7.0, -7.0 });
  const auto first = [&room](std::int64_t count) { return PointSpan<2>(room).Part(0, count); };
  for (const std::int64_t wrong : { 0, 16, 18, 19, 21, 50, 52 })
  {
    const auto expectBoth = [wrong](const std::string& message, const char* right) {
      EXPECT_NE(message.find("for " + std::to_string(wrong) + " positions"), std::string::npos)
        << message;
      EXPECT_NE(message.find(std::string("must be ") + right), std::string::npos) << message;
    };
    const std::vector<double> times{ 0.0, 0.5, 1.0 };
    expectBoth(refusal([&]() { flow.Forward(seeds, first(wrong)); }), "17");
    expectBoth(refusal([&]() { flow.Backward(seeds, first(wrong)); }), "17");
    expectBoth(refusal([&]() { flow.ForwardAt(seeds, times, first(wrong)); }), "51");
    expectBoth(refusal([&]() {
      flow.Forward(FlowSeeds<2>::Lattice({ 4, 5 }), first(wrong));
    }),
      "20");
    expectBoth(refusal([&]() {
      flow.Backward(FlowSeeds<2>::Lattice({ 4, 5 }), first(wrong));
    }),
      "20");
  }
  EXPECT_EQ(room, Points<2>(60, Point<2>{ -7.0, -7.0 }));
}

// The first point that is not a number is named; nothing is moved.
TEST(Errors, PointsThatAreNotFinite)
{
  const RectifiedFlow<2> flow = makeFlow(uniformDensity<2>({ 8, 8 }));
  for (const double bad : { NaN, Infinity, -Infinity })
  {
    Points<2> points(200, Point<2>{ 1.0, 1.0 });
    points[137][1] = bad;
    points[160][0] = bad;
    EXPECT_NE(refusal([&]() { flow.Forward(points, points); }).find("137"), std::string::npos);
    EXPECT_NE(refusal([&]() { flow.Backward(points, points); }).find("137"), std::string::npos);
    EXPECT_EQ(points[0][0], 1.0);
  }
}

TEST(Errors, LimitsOfTheOptionsAreValid)
{
  const RectifiedFlow<2> flow = makeFlow(twoGaussians<2>({ 12, 9 }));
  const Points<2> seeds = randomPoints<2>(flow.Size(), 20);
  for (const Integrator method :
    { Integrator::Multistep, Integrator::RungeKutta4, Integrator::Euler })
  {
    for (const int count : { 1, 2, 3, 10000 })
    {
      const FlowOptions options = steps(count, method);
      const Points<2> positions = runForward(flow, seeds, options);
      const Points<2> back = runBackward(flow, seeds, options);
      EXPECT_EQ(Strays<2>(positions, uniformDensity<2>(flow.Size())).Outside, 0)
        << nameOf(method) << " " << count;
      EXPECT_EQ(Strays<2>(back, uniformDensity<2>(flow.Size())).Outside, 0)
        << nameOf(method) << " " << count;
    }
  }
}

TEST(Errors, NoParticlesIsNoError)
{
  const RectifiedFlow<3> flow = makeFlow(uniformDensity<3>({ 4, 4, 4 }));
  EXPECT_EQ(flow.Forward({}, {}).Evaluations, 0);
  EXPECT_EQ(flow.Backward({}, {}).Evaluations, 0);
  EXPECT_EQ(flow.ForwardAt({}, { 0.5 }, {}).Evaluations, 0);
}

} // namespace
} // namespace RectifiedTransport
