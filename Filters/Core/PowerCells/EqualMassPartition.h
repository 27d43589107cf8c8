// SPDX-License-Identifier: BSD-3-Clause
// The power diagram whose cells have equal masses of a density: the optimal transport, for the
// squared distance, from the density to equal masses at its sites (Aurenhammer, Hoffmann and
// Aronov, "Minkowski-Type Theorems and Least-Squares Clustering", Algorithmica 20, 1998).
#ifndef RectifiedTransport_EqualMassPartition_h
#define RectifiedTransport_EqualMassPartition_h

#include "Core/Algebra/GraphLaplacian.h"
#include "Core/PowerCells/PowerDiagram.h"
#include "Core/PowerCells/RowMoments.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// The weights of the diagram maximize a concave function; its gradient is the mass that each cell
// lacks. Newton's method finds them with steps that leave no cell without mass (Kitagawa, Merigot
// and Thibert, "Convergence of a Newton algorithm for semi-discrete optimal transport", J. Eur.
// Math. Soc. 21(9), 2019), damped if the density has separate parts. The few cells that a longer
// step would leave without mass get larger weights, which also raise the function.
class EqualMassPartition
{
public:
  // Integrals over a cell.
  struct CellIntegrals
  {
    double Mass;
    Point<2> Centroid;
    double Spread; // integral of |x - centroid|^2
  };

  // The mass of the density is the number of sites, so that each cell shall have mass 1.
  EqualMassPartition(RowMoments density, std::int64_t sites);

  // Sets the sites, at least one and no two coincident, inside or outside the domain, and finds the
  // weights, beginning with those of the last solution. Returns false if some mass is not 1 to
  // `massTolerance`; the next call then begins with the previous solution. Throws std::bad_alloc
  // and Cancelled.
  bool Solve(ConstPointSpan<2> sites, Progress& progress);
  static constexpr double massTolerance = 5e-7;

  // After a solution:
  const RowMoments& Density() const { return this->Rows; }
  const PowerDiagram& Diagram() const { return this->Cells; }
  const CellIntegrals& Integrals(std::int64_t site) const
  {
    return this->Integrated[static_cast<std::size_t>(site)];
  }
  const Point<2>& Centroid(std::int64_t site) const { return this->Integrals(site).Centroid; }
  // The integral of |x - site|^2 over a cell.
  double Cost(std::int64_t site) const;
  // How many linear systems the last call solved.
  int NewtonSteps() const { return this->Steps; }

private:
  using Vector = std::vector<double>;
  struct Side
  {
    double Mass;     // the part of the cell's mass, by RowMoments
    double Strength; // minus the derivative of the mass by the weight of the neighbour
  };
  struct Place
  {
    std::int64_t Chunk;
    std::int64_t First; // side
  };
  // How far the masses are from 1.
  struct Deviation
  {
    double Norm;    // Euclidean
    double Largest; // absolute value
    double Least;   // mass
  };

  void SetSites(ConstPointSpan<2> sites, Progress& progress);
  void FindFirstWeights();
  Deviation Evaluate(const Vector& weights, Progress& progress);
  // The same after raising weights until all cells have at least `least`, if only few have less.
  Deviation EvaluateRevived(Vector& weights, double least, Progress& progress);
  double RevivingWeight(std::int64_t site, double weight, double least) const;
  // Calls visit(place) for the cells, in chunks. The first slice has `units` of them.
  template <class Visit>
  void VisitCells(Progress& progress, std::int64_t units, const Visit& visit);
  void PrefetchCell(std::int64_t place) const;
  void IntegrateSides(std::int64_t place);
  void AddSides(std::int64_t site);
  Side Integrate(std::int64_t site, std::int64_t side) const;
  // The sides of a site's cell, in the order of its corners.
  const Side* SidesOf(std::int64_t site) const;
  bool SolveFromHere(Progress& progress);
  bool SolveFromEvenDensity(Progress& progress);
  bool Ascend(double tolerance, int mostShort, Progress& progress);
  bool FactorizeHere(double damping, Progress& progress);
  bool FindDirection();
  double Slope(const Vector& weights) const;
  void IntegrateCells(Progress& progress);
  CellIntegrals IntegrateCell(std::int64_t site) const;

  RowMoments Rows;
  PowerDiagram Cells;
  Vector Weights;
  std::vector<Point<2>> SolvedSites; // sites of the last solution, with its integrals
  Vector SolvedWeights;
  std::vector<CellIntegrals> Integrated;

  Deviation Found{};                    // deviation for the weights that were evaluated last
  Vector Masses;                        // masses of the cells for these weights
  std::vector<std::vector<Side>> Sides; // sides of these cells, by the diagram's chunks
  std::vector<Place> Places;            // where each site's sides are
  GraphLaplacian System;                // the linear system of Newton's method
  // Newton's direction: a change of every weight.
  Vector Direction;
  int Steps = 0;
};

} // namespace RectifiedTransport

#endif
