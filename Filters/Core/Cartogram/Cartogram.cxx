// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/Cartogram.h"

#include "Core/Cartogram/EdgeLengths.h"
#include "Core/Cartogram/RegionRaster.h"
#include "Core/Cartogram/RegionValues.h"
#include "Core/Cartogram/Sea.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Geometry/PointBounds.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// If densities span more than this, the first pass takes their square roots: with the full
// contrast, borders would cross.
constexpr double wideSpan = 99.9;
// The factor on the flow's tolerance in a pass that another one follows: it need not be exact.
constexpr double coarser = 4.0;

// The largest relative error of a region, of either sign.
double largestOf(const std::vector<double>& errors)
{
  double largest = 0.0;
  for (const double error : errors)
  {
    largest = std::max(largest, std::abs(error));
  }
  return largest;
}

class CartogramRun
{
public:
  CartogramRun(RegionMap& map, const std::vector<double>& masses, const CartogramBox& box,
    const CartogramOptions& options, OverlayPoints& overlays, CartogramStart& start,
    const Context& context)
    : Map(map)
    , Masses(masses)
    , Regions(static_cast<std::int32_t>(masses.size()))
    , Box(box)
    , Options(options)
    , Overlays(overlays)
    , Start(start)
    , Work(context)
  {
    // Half the tolerance is for the flow, the other half for the raster.
    this->Options.Flow.AreaTolerance = 0.5 * options.Tolerance;
    this->Options.Flow.NeedsEstimate = false; // the areas of the regions are measured
  }

  CartogramResult Run()
  {
    this->Areas = this->Map.Areas(this->Regions);
    this->FindErrors();
    Stages stages(this->Work,
      { { "raster", this->Start.Raster ? 0.0 : 10.0 }, { "growth", 2 }, { "edges", 3 },
        { "passes", 85 } });
    if (!this->Start.Raster)
    {
      this->Start.Raster = this->RasterNow(stages["raster"]);
    }
    std::shared_ptr<const RegionRaster> raster = this->Start.Raster;
    this->FindOverlaps(*raster);
    // Regions whose outlines cross have no clear area; nothing is moved then.
    this->FindCrossing(raster->Covered());
    if (!this->Found.Crossing.empty())
    {
      return std::move(this->Found);
    }
    this->Around.emplace(this->Options, this->Box, *raster, this->Masses, this->Areas);
    this->Found.Growth = this->Around->Growth();
    this->FillGrowth(*raster, stages["growth"]);
    // The edges are divided before the first pass, since a straight edge stays straight between its
    // end points.
    this->Divide([this](const Point<2>& middle) { return this->Lengths().ExpansionAt(middle); },
      stages["edges"]);
    Rounds passes(stages["passes"], 1); // how many there are is not known
    // The flow's tolerance is refined to no less than this part of its first value.
    constexpr double finest = 1.0 / 64.0;
    double finer = 1.0;
    double stuckBefore = std::numeric_limits<double>::infinity();
    double predictedBefore = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < this->Options.MaximumPasses; ++pass)
    {
      Stages parts(passes.Next(),
        { { "raster", pass > 0 ? 30.0 : 0.0 }, { "densities", 7 }, { "cells", 12 },
          { "edges", pass > 0 ? 3.0 : 0.0 }, { "tables", 15 }, { "points", 2 }, { "flow", 28 },
          { "fellows", this->Overlays.empty() ? 0.0 : 3.0 } });
      if (pass > 0)
      {
        raster = this->RasterNow(parts["raster"]);
      }
      // Only the first pass may take roots; later ones see smaller contrasts.
      const bool isTempered = pass == 0 && this->SpansWidely();
      const RegionValues values = this->FillPass(*raster, isTempered, parts);
      if (pass > 0)
      {
        this->Divide([this](const Point<2>& middle) { return this->Lengths().ByContrast(middle); },
          parts["edges"]);
      }
      const bool mayFollow = pass + 1 < this->Options.MaximumPasses;
      CartogramPass found;
      found.PredictedError = largestOf(values.Errors);
      const bool isCoarse =
        mayFollow && (isTempered || (!values.Exponents.empty() && this->AreFarFromConverged()));
      FlowOptions options = this->Options.Flow;
      options.AreaTolerance = std::min(1.0, (isCoarse ? coarser : finer) * options.AreaTolerance);
      if (this->Found.Overlap > leastOverlap && found.PredictedError > this->Options.Tolerance)
      {
        // Overlapping regions cannot all have their areas, so a more exact flow gains nothing.
        options.AreaTolerance = std::max(options.AreaTolerance, FlowOptions::UsualTolerance);
      }
      if (!this->MoveAll(options, found, parts))
      {
        break;
      }
      const CartogramPass& done = this->Evaluate();
      // `stuck` is the largest error of regions at their least density, `others` that of all other
      // regions.
      double stuck = 0.0;
      double others = 0.0;
      for (std::size_t i = 0; i < this->Found.Errors.size(); ++i)
      {
        double& largest = values.Least[i] != 0 ? stuck : others;
        largest = std::max(largest, std::abs(this->Found.Errors[i]));
      }
      // An error that the raster does not foretell comes from the flow, which gets a finer
      // tolerance.
      if (!isCoarse && found.PredictedError < 0.5 * this->Options.Tolerance)
      {
        finer = std::max(finest, finer / coarser);
      }
      // A region that is stuck at its least density improves through its neighbours' parts of
      // border cells, so passes go on while its error halves.
      const double tolerance = this->Options.Tolerance;
      const bool isDone =
        (done.LargestError <= tolerance && this->Around->LeavesLand(this->Areas)) ||
        (!isTempered && others <= tolerance && stuck > 0.5 * stuckBefore);
      // Overlapping regions end if the areas are what the raster foretells and do not improve by
      // half.
      const bool isPredicted = !isTempered && this->Found.Overlap > leastOverlap &&
        found.PredictedError > tolerance && found.PredictedError > 0.5 * predictedBefore &&
        this->IsAsPredicted(values);
      if (isDone || isPredicted || !mayFollow)
      {
        this->NameOutOfReach(values);
        break;
      }
      predictedBefore = isTempered ? predictedBefore : found.PredictedError;
      stuckBefore = stuck > 0.0 ? stuck : std::numeric_limits<double>::infinity();
    }
    return std::move(this->Found);
  }

private:
  // Overlaps become parts of the total area, and of each region's area.
  void FindOverlaps(const RegionRaster& raster)
  {
    std::vector<double>& overlaps = this->Found.Overlaps;
    this->Found.Overlap = raster.Overlap(overlaps) / sumAll(this->Areas);
    this->Found.Overlapping = static_cast<std::int32_t>(
      std::max_element(overlaps.begin(), overlaps.end()) - overlaps.begin());
    for (std::size_t i = 0; i < overlaps.size(); ++i)
    {
      overlaps[i] /= this->Areas[i];
    }
  }

  // Returns whether the areas are those that the raster foretells for overlapping regions. They
  // cannot all be right, and another pass does not improve them.
  bool IsAsPredicted(const RegionValues& values) const
  {
    double total = 0.0;
    for (std::size_t i = 0; i < this->Masses.size(); ++i)
    {
      total += this->Masses[i] * (1.0 + values.Errors[i]);
    }
    double farthest = 0.0;
    for (std::size_t i = 0; i < this->Masses.size(); ++i)
    {
      const double foretold = (1.0 + values.Errors[i]) * sumAll(this->Masses) / total;
      farthest = std::max(farthest, std::abs((1.0 + this->Found.Errors[i]) / foretold - 1.0));
    }
    return farthest <= 2.0 * this->Options.Tolerance;
  }

  // Finds regions whose outlines cross: an area that runs in the reverse direction counts
  // negatively in the polygon's area, but not in the raster's cover.
  void FindCrossing(const std::vector<double>& covered)
  {
    // Rounding of the raster's exact cover is far below this part of the area.
    constexpr double part = 1e-3;
    for (std::size_t i = 0; i < covered.size(); ++i)
    {
      if (!(std::abs(covered[i] - this->Areas[i]) <= part * this->Areas[i]))
      {
        this->Found.Crossing.push_back(static_cast<std::int32_t>(i));
      }
    }
  }

  std::shared_ptr<const RegionRaster> RasterNow(Progress& progress)
  {
    return std::make_shared<const RegionRaster>(this->Map, this->Regions, this->Box.Side, progress);
  }

  // Returns the mean density of all regions, as mass per cell.
  double MeanDensity() const { return sumAll(this->Masses) / sumAll(this->Areas); }

  bool SpansWidely() const
  {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (std::size_t i = 0; i < this->Masses.size(); ++i)
    {
      const double density = this->Masses[i] / this->Areas[i];
      least = std::min(least, density);
      most = std::max(most, density);
    }
    // Regions below the least density get it, so that they do not widen the span.
    return most > wideSpan * std::max(least, leastRegionDensity * this->MeanDensity());
  }

  // Fills the raster with the ratio of each region's density to the mean, at least 1: it is how
  // much the region grows.
  void FillGrowth(const RegionRaster& raster, Progress& progress)
  {
    const double mean = this->MeanDensity();
    std::vector<double> growth(this->Masses.size());
    for (std::size_t i = 0; i < growth.size(); ++i)
    {
      growth[i] = std::max(1.0, this->Masses[i] / this->Areas[i] / mean);
    }
    raster.Fill(growth, 1.0, this->Cells, progress);
  }

  EdgeLengths Lengths() const { return { this->Cells, this->Box.Side }; }

  // Divides edges, and keeps for each new point its place in the map as it was given.
  template <class LongestAt>
  void Divide(const LongestAt& longestAt, Progress& progress)
  {
    if (this->Found.Before.empty())
    {
      this->Found.Before = this->Map.Points();
    }
    for (const DividingPoint& point : this->Map.Divide(longestAt, progress))
    {
      const Point<2>& a = this->Found.Before[static_cast<std::size_t>(point.First)];
      const Point<2>& b = this->Found.Before[static_cast<std::size_t>(point.Second)];
      const Point<2> place{ a[0] + point.At * (b[0] - a[0]), a[1] + point.At * (b[1] - a[1]) };
      this->Found.Before.push_back(place);
      this->Found.Added.push_back(point);
    }
  }

  // Returns whether errors are large and have fallen to less than half.
  bool AreFarFromConverged() const
  {
    constexpr double far = 10.0; // in tolerances
    const std::vector<CartogramPass>& passes = this->Found.Passes;
    const double largest = passes.empty() ? HUGE_VAL : passes.back().LargestError;
    return largest > far * this->Options.Tolerance &&
      (passes.size() < 2 || largest < 0.5 * passes[passes.size() - 2].LargestError);
  }

  // Fills the raster with densities that give each region its mass (RegionValues.h). With roots,
  // the masses are area * mean * sqrt(density / mean): half the way on a logarithmic scale.
  RegionValues FillPass(const RegionRaster& raster, bool takesRoots, Stages& parts)
  {
    const double mean = this->MeanDensity();
    std::vector<double> masses(this->Masses.size());
    for (std::size_t i = 0; i < masses.size(); ++i)
    {
      // The mass of the region at the mean density.
      const double plain = this->Areas[i] * mean;
      masses[i] = takesRoots ? plain * std::sqrt(this->Masses[i] / plain) : this->Masses[i];
    }
    const double sea = this->Around->DensityOf(raster, masses, this->Areas, takesRoots);
    const double least = leastRegionDensity * sumAll(masses) / sumAll(this->Areas);
    RegionValues values = findRegionValues(
      raster, { masses, this->Areas, sea, least, this->Options.Tolerance }, parts["densities"]);
    Rounds fills(parts["cells"], 1);
    const auto fill = [&](double around) {
      raster.Fill(values.Densities, around, this->Cells, fills.Next());
      if (!values.Exponents.empty())
      {
        raster.Scale(values.Exponents, least, this->Cells, fills.Next());
      }
    };
    fill(sea);
    if (this->Options.Sea == SeaDensity::Mean && this->Found.Overlap > leastOverlap)
    {
      // Land that several regions share has the mass of all of them, and their areas count it for
      // each. So the sea gets the mean density of the land, not of the regions.
      fill(raster.MeanOnLand(this->Cells));
    }
    return values;
  }

  // Moves all points by the backward flow, from the density to the uniform measure. Returns whether
  // the pass was done; otherwise the points are where they were.
  bool MoveAll(FlowOptions options, CartogramPass pass, Stages& parts)
  {
    const std::int64_t side = this->Box.Side;
    const DensityArray<2, double> array(this->Cells.data(), { side, side });
    if (this->Flow)
    {
      this->Flow.emplace(
        RectifiedFlow<2>(DensitySource<2>(array), std::move(*this->Flow), parts["tables"]));
    }
    else
    {
      this->Flow.emplace(DensitySource<2>(array), parts["tables"]);
    }
    std::vector<Point<2>>& points = this->Map.Points();
    // Coincident points move once, so that borders stay closed to the last bit.
    const DistinctPoints<2> before(points, parts["points"]);
    std::vector<Point<2>> moved(before.Places().size());
    // Areas before the pass, with which turned rings are found.
    const std::vector<double> ringAreas = this->RingAreas();
    Rounds flows(parts["flow"], 1);
    for (;;)
    {
      const FlowReport report =
        this->Flow->Backward(ConstPointSpan<2>(before.Places()), moved, options, flows.Next());
      before.Move(moved, points);
      pass.NumberOfSteps = report.NumberOfSteps;
      this->CountInvertedRings(ringAreas);
      if (this->Found.Folded == 0)
      {
        break;
      }
      // A ring that turns over shows an error of the integration: more steps, up to MostSteps,
      // reduce it.
      const int steps = 2 * std::max(report.NumberOfSteps, FlowOptions::FewestSteps);
      if (steps > FlowOptions::MostSteps || options.Integrator != Integrator::Multistep)
      {
        before.Move(before.Places(), points);
        return false;
      }
      options.NumberOfSteps = steps;
    }
    this->MoveOverlays(options, parts["fellows"]);
    this->Areas = this->Map.Areas(this->Regions);
    this->Found.Passes.push_back(pass);
    return true;
  }

  // The area of each ring, by which CountInvertedRings finds rings that turn over.
  std::vector<double> RingAreas() const
  {
    std::vector<double> areas;
    for (std::int64_t ring = 0; ring < this->Map.Rings(); ++ring)
    {
      areas.push_back(this->Map.AreaOf(ring));
    }
    return areas;
  }

  // Counts the rings that had an area and now have none, or a negative one.
  void CountInvertedRings(const std::vector<double>& before)
  {
    // In squares of a cell.
    constexpr double rounding = 1e-9;
    const std::vector<double> now = this->RingAreas();
    this->Found.Folded = 0;
    for (std::size_t ring = 0; ring < now.size(); ++ring)
    {
      if (before[ring] > rounding && !(now[ring] > 0.0) && this->Found.Folded++ == 0)
      {
        this->Found.FirstFolded = this->Map.RegionOf(static_cast<std::int64_t>(ring));
      }
    }
  }

  // A point outside the box moves like the nearest point of its border, by the same displacement.
  void MoveOverlays(const FlowOptions& options, Progress& progress)
  {
    if (this->Overlays.empty())
    {
      return;
    }
    const auto side = static_cast<double>(this->Box.Side);
    std::vector<Point<2>> clamped = this->Overlays;
    for (Point<2>& place : clamped)
    {
      place = { std::clamp(place[0], 0.0, side), std::clamp(place[1], 0.0, side) };
    }
    std::vector<Point<2>> moved = clamped;
    this->Flow->Backward(ConstPointSpan<2>(clamped), moved, options, progress);
    for (std::size_t i = 0; i < moved.size(); ++i)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        this->Overlays[i][axis] = moved[i][axis] + (this->Overlays[i][axis] - clamped[i][axis]);
      }
    }
  }

  // Computes the relative errors of the current areas: area * (total mass / total area) / mass - 1.
  void FindErrors()
  {
    const double perArea = this->MeanDensity();
    this->Found.Errors.resize(this->Masses.size());
    for (std::size_t i = 0; i < this->Masses.size(); ++i)
    {
      this->Found.Errors[i] = this->Areas[i] * perArea / this->Masses[i] - 1.0;
    }
  }

  // Measures the errors after a pass, and names the region with the largest one.
  const CartogramPass& Evaluate()
  {
    this->FindErrors();
    CartogramPass& pass = this->Found.Passes.back();
    const std::vector<double>& errors = this->Found.Errors;
    const auto worst = std::max_element(
      errors.begin(), errors.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    pass.LargestError = std::abs(*worst);
    pass.Worst = static_cast<std::int32_t>(worst - errors.begin());
    return pass;
  }

  // Lists the regions at their least density that miss the tolerance, except those that overlap.
  void NameOutOfReach(const RegionValues& values)
  {
    for (std::size_t i = 0; i < this->Found.Errors.size(); ++i)
    {
      if (values.Least[i] != 0 && std::abs(this->Found.Errors[i]) > this->Options.Tolerance &&
        !(this->Found.Overlaps[i] > this->Options.Tolerance))
      {
        this->Found.OutOfReach.push_back(static_cast<std::int32_t>(i));
      }
    }
  }

  RegionMap& Map;
  const std::vector<double>& Masses;
  const std::int32_t Regions;
  const CartogramBox& Box;
  CartogramOptions Options;
  OverlayPoints& Overlays;
  CartogramStart& Start;
  Progress Work;
  std::vector<double> Areas; // areas of the regions, in cells
  std::optional<Sea> Around;
  std::vector<double> Cells; // densities of the raster's cells, axis 0 fastest
  std::optional<RectifiedFlow<2>> Flow;
  CartogramResult Found;
};

} // namespace

// A square around the map with the margin on each side, divided into Resolution cells along a side.
CartogramBox boxAround(const RegionMap& map, const CartogramOptions& options)
{
  const auto bounds = Bounds<2>::Of(map.Points());
  const double side = bounds.LongestSide() * (1.0 + 2.0 * options.Margin);
  return { { 0.5 * (bounds.Low[0] + bounds.High[0] - side),
             0.5 * (bounds.Low[1] + bounds.High[1] - side) },
    side / static_cast<double>(options.Resolution), options.Resolution };
}

CartogramResult runCartogram(RegionMap& map, const std::vector<double>& masses,
  const CartogramBox& box, const CartogramOptions& options, OverlayPoints& overlays,
  CartogramStart& start, const Context& context)
{
  return CartogramRun(map, masses, box, options, overlays, start, context).Run();
}

} // namespace RectifiedTransport
