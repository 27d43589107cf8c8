// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/RegionValues.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Progress.h"

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Rows are regions; the matrix is sparse, because few pairs of regions share a cell.
using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

// The linear system M d = m - around * rest, by which the densities d give the regions the masses
// m.
struct System
{
  Matrix Common;                 // M
  std::vector<double> Uncovered; // the area, in cells, that each region shares with the rest
};

// Builds M with M_ij = sum over cells of (signed part of i) * (part of j), so that (M d)_i + around
// * rest_i is the mass within region i.
System systemOf(const RegionRaster& raster, Progress& progress)
{
  const std::int32_t regions = raster.Regions();
  System system{ Matrix(regions, regions),
    std::vector<double>(static_cast<std::size_t>(regions), 0.0) };
  // A hash map holds the few pairs of regions that share cells.
  std::unordered_map<std::int64_t, double> entries; // by row * regions + column
  const auto entry = [&](std::int32_t row, std::int32_t column) -> double& {
    return entries[static_cast<std::int64_t>(row) * regions + column];
  };
  for (std::int32_t region = 0; region < regions; ++region)
  {
    // Whole cells of a region contribute 1 each to its diagonal.
    entry(region, region) = raster.WholeCells(region);
  }
  const RegionSets& sets = raster.Sets();
  std::vector<double> cellsOf; // cells of each set, with mixed ones
  for (std::int32_t set = sets.First(); set < sets.End(); ++set)
  {
    cellsOf.push_back(static_cast<double>(raster.WholeCellsOfSet(set)));
  }
  struct SetShare // a share of a region in the cells of a set
  {
    double Part = 0.0;
    double Signed = 0.0;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, SetShare> setShares; // by set and region
  // Along a border, cells mostly have the same regions as the previous cell, so pointers to their
  // entries are kept.
  std::vector<std::int32_t> regionsBefore;
  std::vector<double*> entriesBefore;
  raster.VisitMixed([&](std::int32_t set, const RegionRaster::Share* shares, std::int64_t count) {
    const bool areSame = std::equal(regionsBefore.begin(), regionsBefore.end(), shares,
      shares + count,
      [](std::int32_t region, const RegionRaster::Share& share) { return region == share.Region; });
    if (!areSame)
    {
      regionsBefore.clear();
      entriesBefore.clear();
      for (std::int64_t i = 0; i < count; ++i)
      {
        regionsBefore.push_back(shares[i].Region);
        for (std::int64_t k = 0; k < count; ++k)
        {
          entriesBefore.push_back(&entry(shares[i].Region, shares[k].Region));
        }
      }
    }
    // The part of the cell with the density around the regions.
    const double rest = uncoveredPart(set, shares, count);
    double* const* ofCell = entriesBefore.data();
    for (std::int64_t i = 0; i < count; ++i)
    {
      progress.Add(count);
      system.Uncovered[static_cast<std::size_t>(shares[i].Region)] += shares[i].Signed * rest;
      for (std::int64_t k = 0; k < count; ++k)
      {
        **ofCell++ += shares[i].Signed * shares[k].Part;
      }
      if (set >= 0)
      {
        SetShare& setShare = setShares[{ set, shares[i].Region }];
        setShare.Part += shares[i].Part;
        setShare.Signed += shares[i].Signed;
      }
    }
    if (set >= 0)
    {
      cellsOf[static_cast<std::size_t>(set - sets.First())] += 1.0;
    }
  });
  for (std::int32_t set = sets.First(); set < sets.End(); ++set)
  {
    progress.Check();
    // Regions of a set cover its cells as a whole: each pair of them shares every cell.
    const double cells = cellsOf[static_cast<std::size_t>(set - sets.First())];
    sets.VisitRegions(set, [&](std::int32_t row) {
      sets.VisitRegions(set, [&](std::int32_t column) { entry(row, column) += cells; });
    });
  }
  for (const auto& [place, setShare] : setShares)
  {
    // A share beside a set meets each region of the set, whose part is 1.
    const std::int32_t region = place.second;
    sets.VisitRegions(place.first, [&, &share = setShare](std::int32_t other) {
      entry(other, region) += share.Part;
      entry(region, other) += share.Signed;
    });
  }
  std::vector<Eigen::Triplet<double, std::int32_t>> triplets;
  for (const auto& [place, value] : entries)
  {
    triplets.emplace_back(static_cast<std::int32_t>(place / regions),
      static_cast<std::int32_t>(place % regions), value);
  }
  system.Common.setFromTriplets(triplets.begin(), triplets.end());
  return system;
}

// Finds the exponents x of the factors e^x of cells. Minimizing the relative entropy to the given
// density under the constraints of the masses has the dual sum of cell masses - sum of x_i *
// mass_i, which is convex. Coordinate descent on it gives each region in turn the exponent with
// which its mass is right (iterative proportional fitting).
class FactorSearch
{
public:
  FactorSearch(const RegionRaster& raster, const RegionTargets& targets, RegionValues& values)
    : Raster(raster)
    , Targets(targets)
    , Values(values)
    , Parts(targets.Masses.size())
    , SetsOf(targets.Masses.size())
  {
    const RegionSets& sets = raster.Sets();
    for (std::int32_t set = sets.First(); set < sets.End(); ++set)
    {
      // A set's cells have the sum of its regions' densities.
      double density = 0.0;
      sets.VisitRegions(set, [&](std::int32_t region) {
        density += values.Densities[static_cast<std::size_t>(region)];
        this->SetsOf[static_cast<std::size_t>(region)].push_back(this->Sets.size());
      });
      this->Sets.push_back(
        { density, density * static_cast<double>(raster.WholeCellsOfSet(set)), 0.0, 1.0 });
    }
    raster.VisitMixed(
      [&](std::int32_t number, const RegionRaster::Share* shares, std::int64_t count) {
        const std::ptrdiff_t set = number >= 0 ? number - sets.First() : -1;
        double density = set >= 0 ? this->Sets[static_cast<std::size_t>(set)].Density
                                  : targets.Around * uncoveredPart(number, shares, count);
        for (std::int64_t i = 0; i < count; ++i)
        {
          const auto region = static_cast<std::size_t>(shares[i].Region);
          density += shares[i].Part * values.Densities[region];
          this->Parts[region].push_back({ this->Cells.size(), shares[i].Part, shares[i].Signed });
        }
        // The least density of a cell may not exceed its density before.
        this->Cells.push_back({ density, std::min(density, targets.Least), set });
        if (set >= 0)
        {
          this->Sets[static_cast<std::size_t>(set)].Mass += density;
        }
      });
    values.Exponents.assign(targets.Masses.size(), 0.0);
  }

  void Run(Progress& progress)
  {
    // Sweeps end when every region is within the tolerance.
    constexpr int mostSweeps = 50;
    double worst = 1.0;
    for (int sweep = 0; sweep < mostSweeps && worst > this->Targets.Tolerance; ++sweep)
    {
      // The largest error before the steps of this sweep.
      worst = 0.0;
      for (std::size_t region = 0; region < this->Parts.size(); ++region)
      {
        progress.Check();
        worst = std::max(worst, this->Step(region));
      }
    }
    for (std::size_t region = 0; region < this->Parts.size(); ++region)
    {
      double& error = this->Values.Errors[region];
      // A positive error that remains belongs to a region at its least density.
      error = this->MassOf(region).Now / this->Targets.Masses[region] - 1.0;
      this->Values.Least[region] = error > this->Targets.Tolerance ? 1 : 0;
    }
  }

private:
  // A set of regions; its cells have their own densities times a common factor.
  struct Set
  {
    double Density; // density of cells without other regions
    double Mass;    // mass of all its cells
    double Exponent;
    double Factor;
  };
  struct Cell
  {
    double Density;
    double Least;
    std::ptrdiff_t Set; // or -1
  };
  struct CellPart
  {
    std::size_t Cell;
    double Part;
    double Signed;
  };
  struct Mass
  {
    double Now;
    double Slope; // derivative with respect to the exponent
  };

  // Returns the mass in a region and its derivative with respect to the region's exponent. Cells at
  // their least density have the derivative 0.
  Mass MassOf(std::size_t region) const
  {
    const double density = this->Values.Densities[region];
    const double scaled = density * exponential(this->Values.Exponents[region]);
    const double least = std::min(this->Targets.Least, density);
    const double whole = this->Raster.WholeCells(static_cast<std::int32_t>(region));
    Mass mass{ whole * std::max(scaled, least), scaled > least ? whole * scaled : 0.0 };
    for (const std::size_t set : this->SetsOf[region])
    {
      const double all = this->Sets[set].Mass * this->Sets[set].Factor;
      mass = { mass.Now + all, mass.Slope + all };
    }
    for (const CellPart& part : this->Parts[region])
    {
      const Cell& cell = this->Cells[part.Cell];
      if (cell.Set >= 0)
      {
        const double now = cell.Density * this->Sets[static_cast<std::size_t>(cell.Set)].Factor;
        mass.Now += part.Signed * now;
        mass.Slope += part.Signed * part.Part * now;
        continue;
      }
      mass.Now += part.Signed * std::max(cell.Density, cell.Least);
      mass.Slope += cell.Density > cell.Least ? part.Signed * part.Part * cell.Density : 0.0;
    }
    return mass;
  }

  // Newton's method on the logarithm of the mass as a function of the exponent, which is convex.
  // Returns the error before the step.
  double Step(std::size_t region)
  {
    // A step changes a cell by at most a factor of e^2, and exponents stay within +-40, where
    // factors neither overflow nor vanish.
    constexpr double longest = 2.0;
    constexpr double farthest = 40.0;
    const Mass mass = this->MassOf(region);
    const double wanted = this->Targets.Masses[region];
    const double error = std::abs(mass.Now / wanted - 1.0);
    if (error <= 0.5 * this->Targets.Tolerance || !(mass.Now > 0.0) || !(mass.Slope > 0.0))
    {
      return error;
    }
    double& exponent = this->Values.Exponents[region];
    // The Newton step for log(mass(x)) = log(wanted): the derivative of log(mass) is slope / mass.
    const double step = naturalLogarithm(wanted / mass.Now) * mass.Now / mass.Slope;
    const double next =
      std::clamp(exponent + std::clamp(step, -longest, longest), -farthest, farthest);
    for (const CellPart& part : this->Parts[region])
    {
      Cell& cell = this->Cells[part.Cell];
      const double before = cell.Density;
      // Only the cells of this region change, so the densities and the sets' masses are updated in
      // place.
      cell.Density *= exponential(part.Part * (next - exponent));
      if (cell.Set >= 0)
      {
        this->Sets[static_cast<std::size_t>(cell.Set)].Mass += cell.Density - before;
      }
    }
    for (const std::size_t set : this->SetsOf[region])
    {
      this->Sets[set].Exponent += next - exponent;
      this->Sets[set].Factor = exponential(this->Sets[set].Exponent);
    }
    exponent = next;
    return error;
  }

  const RegionRaster& Raster;
  const RegionTargets& Targets;
  RegionValues& Values;
  std::vector<Set> Sets;   // sets of two or more regions
  std::vector<Cell> Cells; // mixed cells
  std::vector<std::vector<CellPart>> Parts;
  std::vector<std::vector<std::size_t>> SetsOf; // sets of each region
};

// Solves for the regions' densities between their bounds, by projected Gauss-Seidel. Returns the
// largest relative error.
double solveForDensities(const RegionRaster& raster, const RegionTargets& targets,
  const std::vector<double>& lowest, const std::vector<double>& highest, RegionValues& found,
  Progress& progress)
{
  // Sweeps end when no density changes by more than 1e-5 of itself.
  constexpr int mostSweeps = 200;
  constexpr double smallestChange = 1e-5;
  const System system = systemOf(raster, progress);
  const auto regions = static_cast<std::size_t>(raster.Regions());
  // The mass within a region is a row of the matrix times the densities, and its part of the rest.
  const auto massOf = [&](std::size_t region) {
    double mass = targets.Around * system.Uncovered[region];
    for (Matrix::InnerIterator entry(system.Common, static_cast<Eigen::Index>(region)); entry;
         ++entry)
    {
      mass += entry.value() * found.Densities[static_cast<std::size_t>(entry.col())];
    }
    return mass;
  };
  // The largest relative change of a density in a sweep.
  double change = 1.0;
  for (int sweep = 0; sweep < mostSweeps && change > smallestChange; ++sweep)
  {
    progress.Check();
    change = 0.0;
    for (std::size_t i = 0; i < regions; ++i)
    {
      const auto index = static_cast<Eigen::Index>(i);
      // The diagonal is positive, unless the region lies outside the raster.
      const double own = system.Common.coeff(index, index);
      if (!(own > 0.0))
      {
        continue;
      }
      // The equation of region i, solved for its own density and projected to its bounds.
      double& density = found.Densities[i];
      const double next =
        std::clamp(density + (targets.Masses[i] - massOf(i)) / own, lowest[i], highest[i]);
      change = std::max(change, std::abs(next - density) / density);
      density = next;
    }
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < regions; ++i)
  {
    constexpr double rounding = 1e-9;
    // The residual of the equations, relative to the mass.
    found.Errors[i] = massOf(i) / targets.Masses[i] - 1.0;
    found.Least[i] = found.Densities[i] <= lowest[i] * (1.0 + rounding);
    worst = std::max(worst, std::abs(found.Errors[i]));
  }
  return worst;
}

// Returns whether many regions overlap: the matrix would have an entry for every pair of them.
bool isCrowded(const RegionSets& sets)
{
  // Four million entries take 50 MB in the matrix, and each sweep visits all of them.
  constexpr std::int64_t mostPairs = std::int64_t{ 1 } << 22;
  std::int64_t pairs = 0;
  for (std::int32_t set = sets.First(); set < sets.End(); ++set)
  {
    pairs += sets.CountOf(set) * sets.CountOf(set);
  }
  return pairs > mostPairs;
}

} // namespace

RegionValues findRegionValues(
  const RegionRaster& raster, const RegionTargets& targets, const Context& context)
{
  // The largest density, relative to mass / area: thin regions next to others would get extreme
  // values.
  constexpr double most = 4.0;
  Progress progress(context);
  progress.Expect(2 * raster.NumberOfShares());
  const auto regions = static_cast<std::size_t>(raster.Regions());
  RegionValues found{ std::vector<double>(regions), {}, std::vector<double>(regions),
    std::vector<unsigned char>(regions) };
  std::vector<double> lowest(regions);
  std::vector<double> highest(regions);
  for (std::size_t i = 0; i < regions; ++i)
  {
    // The density of a region that shares no cell: mass by area, the first guess.
    const double plain = targets.Masses[i] / targets.Areas[i];
    lowest[i] = std::min(targets.Least, plain);
    highest[i] = std::max(most * plain, lowest[i]);
    found.Densities[i] = std::max(plain, lowest[i]);
  }
  if (isCrowded(raster.Sets()) ||
    solveForDensities(raster, targets, lowest, highest, found, progress) > targets.Tolerance)
  {
    FactorSearch(raster, targets, found).Run(progress);
  }
  return found;
}

} // namespace RectifiedTransport
