// SPDX-License-Identifier: BSD-3-Clause
// A solved map at any points: x - grad potential, which Newton's method on the inverse map may
// improve, and never into a void of the target.
#ifndef RectifiedTransport_PointMap_h
#define RectifiedTransport_PointMap_h

#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/Nodes/NodeMap.h"
#include "Core/OptimalMap/PotentialSolver.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// How the images of points between nodes are found.
enum class PointImages
{
  Inverted,    // by Newton's method on the map from the other side
  Interpolated // in a fraction of the time
};

// The map T(x) = x - grad phi(x) from one side of a solver to the other.
template <int Dimension>
class PointMap
{
public:
  // The solver's sides and the target must live as long. `sides` are those of the target's cells,
  // in lengths. Throws std::bad_alloc and Cancelled.
  PointMap(const PotentialSolver<Dimension>& solver, int from, const CellDensity<Dimension>& target,
    const Point<Dimension>& sides, PointImages images, Progress& progress);

  // The images of the nodes, in cells of the nodes.
  const NodeMap<Dimension>& AtNodes() const { return this->There; }
  // From the index space of the one density to that of the other.
  Point<Dimension> At(const double* point) const;
  // The same from cells of the nodes.
  Point<Dimension> AtPlace(const Point<Dimension>& place) const;
  // The image of a part of a cell; `image` is what AtNodes interpolates there.
  Point<Dimension> AtSample(
    const CellSample<Dimension>& sample, const Point<Dimension>& image) const;

private:
  // Newton's method on F(y) = inverse map of y - x: the residual F, dF/dy, and |F|, all in cells.
  using Matrix = std::array<Point<Dimension>, Dimension>;
  struct Inverse
  {
    Point<Dimension> Residual;
    Matrix Jacobian;
    double Size; // |Residual|
  };

  bool HasMass(const Point<Dimension>& image) const;
  Point<Dimension> ToTarget(const Point<Dimension>& image) const;
  Point<Dimension> LeastCost(const Point<Dimension>& place, const Point<Dimension>& image) const;
  void Improve(const Point<Dimension>& place, Point<Dimension>& image) const;
  Inverse InverseAt(const Point<Dimension>& image, const Point<Dimension>& place) const;

  const PointImages Images;
  const CellDensity<Dimension>& Target;
  const Point<Dimension> CellSides;
  const CellPlacement<Dimension> SourcePlacement;
  const CellPlacement<Dimension> TargetPlacement;
  NodeMap<Dimension> There;
  NodeMap<Dimension> Back; // with Inverted
  // With voids: the potential of the target, and the node with mass of least cost for each node.
  const double* Potential;
  LargeBuffer<std::int64_t> Minimizers;
};

} // namespace RectifiedTransport

#endif
