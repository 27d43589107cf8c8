// SPDX-License-Identifier: BSD-3-Clause
// Cells in arrays, for tests of what is resampled to grids.
#ifndef RectifiedTransport_TestCellSet_h
#define RectifiedTransport_TestCellSet_h

#include "Core/Parallel/Progress.h"
#include "Core/Resampling/CellValues.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

class TestCells final : public CellSet
{
public:
  struct Cell
  {
    CellShape Shape;
    CellReader::Ids Points;
  };

  TestCells(std::vector<Point<3>> points, std::vector<Cell> cells)
    : Points(std::move(points))
    , Cells(std::move(cells))
  {
    this->NumberOfPoints = static_cast<std::int64_t>(this->Points.size());
    this->NumberOfCells = static_cast<std::int64_t>(this->Cells.size());
    this->Rounding = 16.0 * std::numeric_limits<double>::epsilon();
  }

  std::unique_ptr<CellReader> Read() const override { return std::make_unique<Reader>(*this); }

private:
  // Divides polygons into fans.
  class Reader final : public CellReader
  {
  public:
    explicit Reader(const TestCells& cells)
      : Set(cells)
    {
    }
    const Cell& At(std::int64_t cell) const
    {
      return this->Set.Cells[static_cast<std::size_t>(cell)];
    }
    CellShape ShapeOf(std::int64_t cell) const override { return this->At(cell).Shape; }
    int DimensionOf(std::int64_t cell) const override
    {
      const CellShape shape = this->ShapeOf(cell);
      return shape == CellShape::Other ? 0
        : shape <= CellShape::PolyLine ? 1
        : shape <= CellShape::Polygon  ? 2
                                       : 3;
    }
    const Ids& PointsOf(std::int64_t cell) override { return this->At(cell).Points; }
    bool Divide(std::int64_t cell, Ids& simplices) override
    {
      const auto& [shape, points] = this->At(cell);
      simplices = points;
      if (shape == CellShape::Quad || shape == CellShape::Polygon)
      {
        simplices.clear();
        for (std::size_t i = 2; i < points.size(); ++i)
        {
          simplices.insert(simplices.end(), { points[0], points[i - 1], points[i] });
        }
      }
      return shape == CellShape::Line || shape == CellShape::Triangle ||
        shape == CellShape::Tetrahedron || simplices != points;
    }
    void GetPosition(std::int64_t point, double* x) const override
    {
      std::copy_n(this->Set.Points[static_cast<std::size_t>(point)].data(), 3, x);
    }

  private:
    const TestCells& Set;
  };

  const std::vector<Point<3>> Points;
  const std::vector<Cell> Cells;
};

inline CellValues valuesOf(const std::shared_ptr<const CellSet>& cells, const MassCells& mass,
  bool onPoints, const std::vector<double>& values, const std::vector<unsigned char>& missing = {})
{
  Progress progress{ Context() };
  std::vector<unsigned char> unused;
  CellValues read(cells, mass, onPoints, missing, unused, progress);
  LargeBuffer<double> density(static_cast<std::int64_t>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    density.data()[i] = unused[i] ? 0.0 : values[i];
  }
  read.SetValues(std::move(density));
  return read;
}

// Cells of sides 1 from the origin on.
inline ImageGrid unitGrid(int x, int y, int z = 0)
{
  return { { 0, x, 0, y, 0, z }, Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(),
    ImageGrid::Matrix::Identity(), false };
}

} // namespace RectifiedTransport

#endif
