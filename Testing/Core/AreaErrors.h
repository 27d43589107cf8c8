// SPDX-License-Identifier: BSD-3-Clause
// Errors of a map from a density to the uniform measure: areas of the images of blocks of cells
// compared with their masses.
#ifndef RectifiedTransport_AreaErrors_h
#define RectifiedTransport_AreaErrors_h

#include "Core/Geometry/ImageMeasure.h"

#include "TestDensities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

constexpr std::int64_t AreaBlock = 4; // cells along each axis
constexpr double LeastOfMean = 0.05;  // of the cells of a block that counts

// Of each block of cells, axis 0 fastest.
struct BlockAreas
{
  std::vector<double> Area; // of its image
  std::vector<double> Mass; // in cells of the mean density
  std::vector<bool> Counts; // all its cells are dense enough
  std::int64_t Folded = 0;  // cells with mass whose images have no positive area

  // The relative errors of the blocks that count, ascending.
  std::vector<double> Errors(const std::vector<double>& exact) const
  {
    std::vector<double> errors;
    for (std::size_t block = 0; block < this->Area.size(); ++block)
    {
      if (this->Counts[block])
      {
        errors.push_back(std::abs(this->Area[block] - exact[block]) / this->Mass[block]);
      }
    }
    std::sort(errors.begin(), errors.end());
    return errors;
  }
};

// What a part of ascending errors keeps; 0 without errors.
inline double quantileOf(const std::vector<double>& errors, double part)
{
  return errors.empty() ? 0.0
                        : errors[std::min(errors.size() - 1,
                            static_cast<std::size_t>(part * static_cast<double>(errors.size())))];
}

// Of areas against masses.
struct AreaErrors
{
  double Quantile999 = 0.0;
  double Quantile99 = 0.0;
  double Mean = 0.0;
  std::int64_t Blocks = 0;
  std::int64_t Folded = 0;
};

// Corners of all cells, axis 0 fastest, `parts` of them along each side of a cell.
template <int Dimension>
std::vector<Point<Dimension>> cornerLattice(const GridSize<Dimension>& size, std::int64_t parts = 1)
{
  GridSize<Dimension> points;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    points[axis] = size[axis] * parts + 1;
  }
  std::vector<Point<Dimension>> corners(static_cast<std::size_t>(cellCount<Dimension>(points)));
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const GridSize<Dimension> at = cellAt<Dimension>(static_cast<std::int64_t>(i), points);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      corners[i][axis] = static_cast<double>(at[axis]) / static_cast<double>(parts);
    }
  }
  return corners;
}

// `images` are those of a cornerLattice of the density.
template <int Dimension>
BlockAreas blockAreas(const TestDensity<Dimension>& density,
  const std::vector<Point<Dimension>>& images, std::int64_t parts = 1)
{
  GridSize<Dimension> points;
  GridSize<Dimension> blocks;
  GridSize<Dimension> inner;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    points[axis] = density.Size[axis] * parts + 1;
    blocks[axis] = density.Size[axis] / AreaBlock;
    inner[axis] = parts;
  }
  double mean = 0.0;
  for (const double value : density.Values)
  {
    mean += value / static_cast<double>(density.Values.size());
  }
  const auto count = static_cast<std::size_t>(cellCount<Dimension>(blocks));
  BlockAreas found{ std::vector<double>(count), std::vector<double>(count),
    std::vector<bool>(count, true), 0 };
  for (std::size_t cell = 0; cell < density.Values.size(); ++cell)
  {
    const GridSize<Dimension> at = cellAt<Dimension>(static_cast<std::int64_t>(cell), density.Size);
    double area = 0.0;
    bool isFolded = false;
    for (std::int64_t part = 0; part < cellCount<Dimension>(inner); ++part)
    {
      const GridSize<Dimension> place = cellAt<Dimension>(part, inner);
      std::array<Point<Dimension>, (1 << Dimension)> corners;
      for (int corner = 0; corner < 1 << Dimension; ++corner)
      {
        GridSize<Dimension> point;
        for (int axis = 0; axis < Dimension; ++axis)
        {
          point[axis] = at[axis] * parts + place[axis] + (corner >> axis & 1);
        }
        corners[corner] = images[cellIndex<Dimension>(point, points)];
      }
      const double measure = imageMeasure<Dimension>(corners.data());
      area += measure;
      isFolded = isFolded || !(measure > 0.0);
    }
    found.Folded += isFolded && density.Values[cell] > 0.0 ? 1 : 0;
    GridSize<Dimension> block;
    bool isInside = true;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      block[axis] = at[axis] / AreaBlock;
      isInside = isInside && block[axis] < blocks[axis];
    }
    if (isInside)
    {
      const auto number = static_cast<std::size_t>(cellIndex<Dimension>(block, blocks));
      found.Area[number] += area;
      found.Mass[number] += density.Values[cell] / mean;
      found.Counts[number] = found.Counts[number] && density.Values[cell] > LeastOfMean * mean;
    }
  }
  return found;
}

template <int Dimension>
AreaErrors measureAreas(const TestDensity<Dimension>& density,
  const std::vector<Point<Dimension>>& images, std::int64_t parts = 1)
{
  const BlockAreas blocks = blockAreas<Dimension>(density, images, parts);
  const std::vector<double> errors = blocks.Errors(blocks.Mass);
  AreaErrors found;
  found.Blocks = static_cast<std::int64_t>(errors.size());
  found.Folded = blocks.Folded;
  found.Quantile999 = quantileOf(errors, 0.999);
  found.Quantile99 = quantileOf(errors, 0.99);
  for (const double error : errors)
  {
    found.Mean += error / static_cast<double>(errors.size());
  }
  return found;
}

} // namespace RectifiedTransport

#endif
