// SPDX-License-Identifier: BSD-3-Clause
// The points of a relaxation in isotropic coordinates, separate from each other. Their order, and
// so all sums over them, depend only on the set of points.
#ifndef RectifiedTransport_RelaxedPoints_h
#define RectifiedTransport_RelaxedPoints_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Relaxation/RelaxationFrame.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Throws std::invalid_argument for options that are out of range.
void check(const RelaxationOptions& options);

// Points come and go in index space, where grid cell i is [i, i + 1].
template <int Dimension>
class RelaxedPoints
{
public:
  // Moves points outside the domain to its border. Throws std::invalid_argument for points that are
  // not finite.
  RelaxedPoints(ConstPointSpan<Dimension> points, const RelaxationFrame<Dimension>& frame);

  std::int64_t Size() const { return static_cast<std::int64_t>(this->X.size()) / Dimension; }
  ConstPointSpan<Dimension> Get() const { return { this->X.data(), this->Size() }; }
  // Writable views on the points and on their coordinates, interleaved.
  PointSpan<Dimension> Get() { return { this->X.data(), this->Size() }; }
  std::vector<double>& Coordinates() { return this->X; }

  // Moves all except one of coincident points by a part of the local spacing, in directions that
  // depend only on their number. Throws Cancelled.
  void Separate(const std::function<double(const Point<Dimension>&)>& spacing, Progress& progress);
  // Sorts the points. Throws Cancelled.
  void Arrange(Progress& progress);

  // Writes the points in their original order. Points that have not moved stay bitwise the same.
  void Write(const GridSize<Dimension>& size, PointSpan<Dimension> points) const;

private:
  Point<Dimension> At(std::int64_t point) const;
  void MoveAside(std::int64_t point, double distance, std::uint64_t ordinal);

  const RelaxationFrame<Dimension> Frame;
  // Current and given coordinates, interleaved, in the frame's units.
  std::vector<double> X;
  std::vector<double> Given;
  std::vector<std::int64_t> Order; // empty: the original order
};

} // namespace RectifiedTransport

#endif
