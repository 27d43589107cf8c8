// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Seeds/BlueNoise.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Progress.h"
#include "Core/Seeds/BlueNoiseWindow.h"
#include "Core/Seeds/WindowBorder.h"

#include <algorithm>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Writes the points from number `first` on, out of `count`, and relaxes those at the border in 2D.
template <int Dimension>
void cutWindow(const Point<Dimension>& lengths, std::int64_t count, std::uint64_t randomSeed,
  std::int64_t first, PointSpan<Dimension> unitPoints, Progress& progress)
{
  BlueNoiseWindow<Dimension> window(lengths, count, randomSeed, progress);
  // The size of the window that holds exactly `count` points.
  window.FindSize();
  std::int64_t number = 0;
  // Points are numbered in the order in which the window emits them.
  const auto write = [&](const Point<Dimension>& point) {
    if (number >= first && number - first < unitPoints.size())
    {
      std::copy(point.begin(), point.end(), unitPoints[number - first]);
    }
    ++number;
  };
  if constexpr (Dimension == 2)
  {
    std::vector<BorderSeed> border; // all seeds at the border, as their cells depend on one another
    const BorderBand band(lengths, count);
    window.Emit([&](const Point<2>& point) {
      if (band.Holds(point.data()))
      {
        border.push_back({ number, point });
      }
      write(point);
    });
    relaxBorder(lengths, count, border, first, unitPoints, progress);
  }
  else
  {
    window.Emit(write);
  }
}

void generateJitteredLine(std::int64_t count, std::uint64_t randomSeed, std::int64_t first,
  PointSpan<1> unitPoints, Progress& progress)
{
  const double n = static_cast<double>(count);
  // One point in each of `count` equal intervals, within its middle half.
  for (std::int64_t i = first; i < first + unitPoints.size(); ++i)
  {
    const double jitter = unitReal(randomWord(randomSeed, static_cast<std::uint64_t>(i)));
    *unitPoints[i - first] = (static_cast<double>(i) + 0.25 + 0.5 * jitter) / n;
    progress.Add(2);
  }
}

// Makes the pattern of the other axes and an additive recurrence along a thin one. Its step is the
// golden ratio in 2D and the square root of 2 in 3D. They differ because both apply if two axes are
// thin.
template <int Dimension>
void generateFlat(const Point<Dimension>& lengths, int thin, std::int64_t count,
  std::uint64_t randomSeed, std::int64_t first, PointSpan<Dimension> unitPoints, Progress& progress)
{
  Point<Dimension - 1> rest;
  for (int a = 0; a < Dimension - 1; ++a)
  {
    rest[a] = lengths[a < thin ? a : a + 1];
  }
  // The pattern is made in the first part of the memory, which is then overwritten from its end on.
  const PointSpan<Dimension - 1> across(unitPoints.data(), unitPoints.size());
  generateBlueNoise<Dimension - 1>(rest, count, randomSeed, first, across, progress);
  constexpr std::uint64_t step = Dimension == 2 ? 0x9E3779B97F4A7C15u : 0x6A09E667F3BCC909u;
  const std::uint64_t shift = randomWord(~randomSeed, Dimension);
  for (std::int64_t i = unitPoints.size() - 1; i >= 0; --i)
  {
    Point<Dimension> point;
    for (int a = 0; a < Dimension - 1; ++a)
    {
      point[a < thin ? a : a + 1] = across[i][a];
    }
    point[thin] = unitReal(shift + static_cast<std::uint64_t>(first + i) * step);
    std::copy(point.begin(), point.end(), unitPoints[i]);
    progress.Add(1);
  }
}

} // namespace

template <int Dimension>
void generateBlueNoise(const Point<Dimension>& lengths, std::int64_t count,
  std::uint64_t randomSeed, std::int64_t first, PointSpan<Dimension> unitPoints, Progress& progress)
{
  if (unitPoints.size() == 0)
  {
    return;
  }
  if constexpr (Dimension == 1)
  {
    generateJitteredLine(count, randomSeed, first, unitPoints, progress);
  }
  else
  {
    // The least thickness of the box for the full pattern, in mean spacings to the power of the
    // dimension. At this thickness, the pattern of one dimension less has the same smallest
    // spacing.
    constexpr double thinnest = Dimension == 2 ? 0.4 : 1.0;
    const int thin =
      static_cast<int>(std::min_element(lengths.begin(), lengths.end()) - lengths.begin());
    // The thickness along the thinnest axis, in mean spacings, to the power of the dimension.
    double power = static_cast<double>(count);
    for (double length : lengths)
    {
      power *= lengths[thin] / length;
    }
    if (power < thinnest)
    {
      generateFlat<Dimension>(lengths, thin, count, randomSeed, first, unitPoints, progress);
    }
    else
    {
      cutWindow<Dimension>(lengths, count, randomSeed, first, unitPoints, progress);
    }
  }
}

template decltype(generateBlueNoise<1>) generateBlueNoise<1>;
template decltype(generateBlueNoise<2>) generateBlueNoise<2>;
template decltype(generateBlueNoise<3>) generateBlueNoise<3>;

} // namespace RectifiedTransport
