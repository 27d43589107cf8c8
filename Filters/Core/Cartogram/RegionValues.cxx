// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/RegionValues.h"

#include "Core/Parallel/Progress.h"

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace RectifiedTransport
{

namespace
{

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

struct System
{
  Matrix Common;            // M
  std::vector<double> Rest; // the area in cells that regions share with the rest
};

System systemOf(const RegionRaster& raster, Progress& progress)
{
  const std::int32_t regions = raster.Regions();
  System system{ Matrix(regions, regions),
    std::vector<double>(static_cast<std::size_t>(regions), 0.0) };
  std::unordered_map<std::int64_t, double> entries; // by row * regions + column
  const auto entry = [&](std::int32_t row, std::int32_t column) -> double& {
    return entries[static_cast<std::int64_t>(row) * regions + column];
  };
  for (std::int32_t region = 0; region < regions; ++region)
  {
    entry(region, region) = raster.WholeCells(region);
  }
  raster.VisitMixed([&](const RegionRaster::Share* shares, std::int64_t count) {
    const double rest = restOf(shares, count);
    for (std::int64_t i = 0; i < count; ++i)
    {
      progress.Add(count);
      system.Rest[static_cast<std::size_t>(shares[i].Region)] += shares[i].Part * rest;
      for (std::int64_t k = 0; k < count; ++k)
      {
        entry(shares[i].Region, shares[k].Region) += shares[i].Part * shares[k].Part;
      }
    }
  });
  std::vector<Eigen::Triplet<double, std::int32_t>> triplets;
  for (const auto& [place, value] : entries)
  {
    triplets.emplace_back(static_cast<std::int32_t>(place / regions),
      static_cast<std::int32_t>(place % regions), value);
  }
  system.Common.setFromTriplets(triplets.begin(), triplets.end());
  return system;
}

} // namespace

RegionValues findRegionValues(const RegionRaster& raster, const std::vector<double>& masses,
  const std::vector<double>& areas, double around, double least, const Context& context)
{
  constexpr int mostSweeps = 200;
  constexpr double smallestChange = 1e-5;
  constexpr double most = 4.0;
  Progress progress(context);
  progress.BeginStage(1.0, 2 * raster.NumberOfShares());
  const System system = systemOf(raster, progress);
  const auto regions = static_cast<std::size_t>(raster.Regions());
  RegionValues found{ std::vector<double>(regions), std::vector<double>(regions),
    std::vector<unsigned char>(regions) };
  std::vector<double> lowest(regions);
  std::vector<double> highest(regions);
  for (std::size_t i = 0; i < regions; ++i)
  {
    const double plain = masses[i] / areas[i];
    lowest[i] = std::min(least * around, plain);
    highest[i] = std::max(most * plain, lowest[i]);
    found.Densities[i] = std::max(plain, lowest[i]);
  }
  const auto massOf = [&](std::size_t region) {
    double mass = around * system.Rest[region];
    for (Matrix::InnerIterator entry(system.Common, static_cast<Eigen::Index>(region)); entry;
         ++entry)
    {
      mass += entry.value() * found.Densities[static_cast<std::size_t>(entry.col())];
    }
    return mass;
  };
  double change = 1.0;
  for (int sweep = 0; sweep < mostSweeps && change > smallestChange; ++sweep)
  {
    progress.Check();
    change = 0.0;
    for (std::size_t i = 0; i < regions; ++i)
    {
      const auto index = static_cast<Eigen::Index>(i);
      const double own = system.Common.coeff(index, index);
      if (!(own > 0.0))
      {
        continue;
      }
      double& density = found.Densities[i];
      const double next =
        std::clamp(density + (masses[i] - massOf(i)) / own, lowest[i], highest[i]);
      change = std::max(change, std::abs(next - density) / density);
      density = next;
    }
  }
  for (std::size_t i = 0; i < regions; ++i)
  {
    constexpr double rounding = 1e-9;
    found.Errors[i] = massOf(i) / masses[i] - 1.0;
    found.Least[i] = found.Densities[i] <= lowest[i] * (1.0 + rounding);
  }
  return found;
}

} // namespace RectifiedTransport
