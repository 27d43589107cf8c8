// SPDX-License-Identifier: BSD-3-Clause
// The power diagram on a square torus whose cells have equal areas: for GenerateBlueNoiseTile.cxx.
#ifndef RectifiedTransport_TorusPartition_h
#define RectifiedTransport_TorusPartition_h

#include "Core/Algebra/SparseCholesky.h"
#include "Core/Parallel/Progress.h"
#include "Core/PowerCells/PowerDiagram.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace RectifiedTransport
{

// Lengths are in units of the mean spacing, so that each cell shall have area 1. Sites near the
// border are repeated beyond it, so that the cells of the square are those of the torus.
class TorusPartition
{
public:
  struct Moments
  {
    double Area = 0.0;
    Point<2> First{};    // the integral of x - site
    double Second = 0.0; // the integral of |x - site|^2
  };

  explicit TorusPartition(double side)
    : Side(side)
    , Work(Context(Threads))
    , Cells({ side + 2.0 * margin, side + 2.0 * margin })
  {
  }

  // Finds the weights by Newton's method, beginning with the last ones, as in EqualMassPartition
  // but only for uniform densities.
  void Solve(const std::vector<Point<2>>& sites)
  {
    this->SetSites(sites);
    this->Weights.resize(sites.size(), 0.0);
    this->Evaluate(this->Weights);
    constexpr double tolerance = 1e-10;
    constexpr int mostSteps = 100;
    for (int step = 0; this->LargestDeviation() > tolerance; ++step)
    {
      if (step == mostSteps)
      {
        throw std::runtime_error("the areas do not become equal");
      }
      const std::vector<double> direction = this->FindDirection();
      std::vector<double> trial(this->Weights.size());
      constexpr double leastArea = 0.1;
      double part = 1.0;
      do
      {
        for (std::size_t i = 0; i < trial.size(); ++i)
        {
          trial[i] = this->Weights[i] + part * direction[i];
        }
        this->Evaluate(trial);
        part *= 0.5;
      } while (this->LeastArea() < leastArea);
      this->Weights.swap(trial);
    }
  }

  // The moments of each site's cell, after Solve.
  const std::vector<Moments>& CellMoments() const { return this->Found; }
  // The mean of |x - site|^2 over the torus.
  double MeanSquare() const
  {
    double sum = 0.0;
    for (const Moments& cell : this->Found)
    {
      sum += cell.Second;
    }
    return sum / (this->Side * this->Side);
  }

private:
  // Wider than two cells.
  static constexpr double margin = 4.0;

  void SetSites(const std::vector<Point<2>>& sites)
  {
    this->Sites.clear();
    this->Originals.clear();
    for (const int ring : { 0, 1 })
    {
      for (std::size_t i = 0; i < sites.size(); ++i)
      {
        for (int y = -ring; y <= ring; ++y)
        {
          for (int x = -ring; x <= ring; ++x)
          {
            const Point<2> site = { sites[i][0] + x * this->Side + margin,
              sites[i][1] + y * this->Side + margin };
            const double end = this->Side + 2.0 * margin;
            if (ring == 0 ||
              ((x != 0 || y != 0) && site[0] > 0.0 && site[0] < end && site[1] > 0.0 &&
                site[1] < end))
            {
              this->Sites.push_back(site);
              this->Originals.push_back(i);
            }
          }
        }
      }
    }
    this->Cells.SetSites(this->Sites, this->Work);
  }

  void Evaluate(const std::vector<double>& weights)
  {
    std::vector<double> repeated(this->Sites.size());
    for (std::size_t i = 0; i < repeated.size(); ++i)
    {
      repeated[i] = weights[this->Originals[i]];
    }
    this->Cells.Update(repeated.data(), this->Work);
    this->Found.assign(weights.size(), Moments());
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      const PowerDiagram::Cell cell = this->Cells[static_cast<std::int64_t>(i)];
      for (std::int64_t k = 0; k < cell.Count; ++k)
      {
        this->AddTriangle(this->Sites[i], cell[k].X, cell.After(k).X, this->Found[i]);
      }
    }
  }

  // Adds the triangle of a site and a side of its cell.
  static void AddTriangle(
    const Point<2>& site, const Point<2>& from, const Point<2>& to, Moments& moments)
  {
    const Point<2> a = { from[0] - site[0], from[1] - site[1] };
    const Point<2> b = { to[0] - site[0], to[1] - site[1] };
    const double area = 0.5 * (a[0] * b[1] - a[1] * b[0]);
    moments.Area += area;
    moments.First[0] += area * (a[0] + b[0]) / 3.0;
    moments.First[1] += area * (a[1] + b[1]) / 3.0;
    moments.Second += area *
      (a[0] * a[0] + a[1] * a[1] + b[0] * b[0] + b[1] * b[1] + a[0] * b[0] + a[1] * b[1]) / 6.0;
  }

  double LargestDeviation() const
  {
    double largest = 0.0;
    for (const Moments& cell : this->Found)
    {
      largest = std::max(largest, std::abs(cell.Area - 1.0));
    }
    return largest;
  }
  double LeastArea() const
  {
    double least = 1.0;
    for (const Moments& cell : this->Found)
    {
      least = std::min(least, cell.Area);
    }
    return least;
  }

  // The derivative of an area by a neighbour's weight is minus the side between them over twice the
  // distance of the sites. Weights are determined up to a constant, which the first one fixes.
  std::vector<double> FindDirection()
  {
    using Real = InterruptibleReal;
    const auto count = static_cast<Eigen::Index>(this->Found.size());
    std::vector<Eigen::Triplet<Real>> values;
    values.emplace_back(0, 0, 1.0);
    SparseCholesky::Vector lacking(count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      lacking[i] = 1.0 - this->Found[static_cast<std::size_t>(i)].Area;
      const PowerDiagram::Cell cell = this->Cells[i];
      for (std::int64_t k = 0; k < cell.Count; ++k)
      {
        const auto neighbour = static_cast<std::size_t>(cell[k].Neighbour);
        const auto j = static_cast<Eigen::Index>(this->Originals[neighbour]);
        const double strength = distance(cell[k].X, cell.After(k).X) /
          (2.0 * distance(this->Sites[static_cast<std::size_t>(i)], this->Sites[neighbour]));
        values.emplace_back(i, i, strength);
        if (j < i)
        {
          values.emplace_back(i, j, -strength);
        }
      }
    }
    SparseCholesky::Matrix lower(count, count);
    lower.setFromTriplets(values.begin(), values.end());
    SparseCholesky system;
    system.Analyze(lower);
    if (!system.Factorize(lower, this->Work))
    {
      throw std::runtime_error("the diagram falls apart");
    }
    const SparseCholesky::Vector solution = system.Solve(lacking);
    std::vector<double> direction(this->Found.size());
    for (Eigen::Index i = 0; i < count; ++i)
    {
      direction[static_cast<std::size_t>(i)] = solution[i].Value;
    }
    return direction;
  }

  static double distance(const Point<2>& a, const Point<2>& b)
  {
    return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
  }

  const double Side;
  SerialExecutor Threads;
  Progress Work;
  PowerDiagram Cells;
  std::vector<Point<2>> Sites;
  std::vector<std::size_t> Originals;
  std::vector<double> Weights;
  std::vector<Moments> Found;
};

} // namespace RectifiedTransport

#endif
