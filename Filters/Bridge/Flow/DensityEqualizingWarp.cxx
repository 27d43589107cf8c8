// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/DensityEqualizingWarp.h"

#include "Bridge/Data/Cells/MeshCells.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Plan/FlowCosts.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Equalize/CorrectedImages.h"
#include "Core/Geometry/Dispatch.h"

#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// Adds the triangles at a polygon's first corner, or the tetrahedra of these and an apex. Their
// signed measures have the same sum as those of any others.
template <class Iterator>
void addFan(Iterator first, Iterator end, const CellReader::Ids& apex, CellReader::Ids& vertices)
{
  for (Iterator corner = first; end - corner > 2; ++corner)
  {
    vertices.insert(vertices.end(), apex.begin(), apex.end());
    vertices.insert(vertices.end(), { *first, corner[1], corner[2] });
  }
}

// Adds tetrahedra between the faces of a polyhedron, which all point outwards, and one corner.
void addFaces(vtkPointSet* cells, vtkIdType cell, CellReader::Ids& vertices)
{
  vtkNew<vtkIdList> stream;
  vtkUnstructuredGrid::SafeDownCast(cells)->GetFaceStream(cell, stream);
  const vtkIdType* face = stream->GetPointer(0) + 1;
  const CellReader::Ids apex{ face[1] };
  for (vtkIdType faces = stream->GetId(0); faces > 0; --faces)
  {
    const vtkIdType* end = face + 1 + *face;
    addFan(face + 1, end, apex, vertices);
    face = end;
  }
}

// Finds the vertices of the simplices that a cell consists of. Returns whether it can be divided.
// VTK takes a time for polygons that grows as the square of their corners, and 70 times as long as
// this for polyhedra.
bool findSimplices(
  vtkPointSet* cells, CellReader& reader, vtkIdType cell, CellReader::Ids& vertices)
{
  vertices.clear();
  const CellShape shape = reader.ShapeOf(cell);
  if (shape == CellShape::Quad || shape == CellShape::Polygon)
  {
    const CellReader::Ids& corners = reader.PointsOf(cell);
    addFan(corners.begin(), corners.end(), {}, vertices);
    return true;
  }
  if (cells->GetCellType(cell) == VTK_POLYHEDRON)
  {
    addFaces(cells, cell, vertices);
    return true;
  }
  return reader.Divide(cell, vertices);
}

template <int D>
InvertedCells count(
  const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after, Progress& progress)
{
  auto* surface = vtkPolyData::SafeDownCast(before);
  if (surface && surface->NeedToBuildCells())
  {
    surface->BuildCells(); // afterwards threads may read cells
  }
  const MeshCells cells(before, "input");
  const double origin[3] = { 0.0, 0.0, 0.0 };
  Point<D> index;
  grid.ToIndex<D>(origin, index.data());
  double offset = 0.0; // how far the origin of index space is from that of the coordinates
  for (const double x : index)
  {
    offset = std::max(offset, std::abs(x));
  }
  constexpr std::int64_t grain = 1024;
  return sumExactly<InvertedCells>(progress, before->GetNumberOfCells(), grain,
    [&](std::int64_t first, std::int64_t last, InvertedCells& found) {
      const auto reader = cells.Read();
      CellReader::Ids vertices;
      std::vector<Point<D>> places;
      std::vector<Point<D>> moved;
      for (vtkIdType cell = first; cell < last; ++cell)
      {
        if (cells.HiddenCells.Has(cell) || reader->DimensionOf(cell) != D ||
          !findSimplices(before, *reader, cell, vertices) || vertices.empty())
        {
          continue;
        }
        places.resize(vertices.size());
        moved.resize(vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i)
        {
          double x[3];
          reader->GetPosition(vertices[i], x);
          grid.ToIndex<D>(x, places[i].data());
          after->GetPoint(static_cast<vtkIdType>(vertices[i]), x);
          grid.ToIndex<D>(x, moved[i].data());
        }
        const int type = before->GetCellType(cell);
        const bool hasPieces = type == VTK_POLY_LINE || type == VTK_TRIANGLE_STRIP;
        const auto simplices = static_cast<std::int64_t>(vertices.size() / (D + 1));
        found.AddCell<D>(places, moved, hasPieces ? simplices : 1, offset);
      }
    });
}

// The points of a warp in index space, clamped to the domain, and in physical space. In 3D the
// index coordinates share the memory of the displacements.
template <int D>
class WarpedPoints
{
public:
  WarpedPoints(const ImageGrid& grid, vtkPointSet* input)
    : Grid(grid)
    , Input(input)
    , Count(input->GetNumberOfPoints())
    , Purpose("the " + std::to_string(this->Count) + " points")
  {
    constexpr double real = sizeof(double);
    const double scratch = D == 3 ? 0.0 : real * D;
    // 3 coordinates and 3 components of the displacement a point and, where D is not 3, D index
    // coordinates.
    requireMemory({ this->Purpose, static_cast<double>(this->Count) * (6 * real + scratch) });
    this->Points = newArray<vtkDoubleArray>("Points", 3, this->Count);
    this->Displacements = newArray<vtkDoubleArray>("Displacement", 3, this->Count);
    withMemory({ this->Purpose, static_cast<double>(this->Count) * scratch },
      [&]() { this->Separate = LargeBuffer<double>(D == 3 ? 0 : this->Count * D); });
    this->Index = D == 3 ? this->Displacements->GetPointer(0) : this->Separate.data();
  }

  // Returns how many points are outside of the domain.
  // Points outside of the domain move as the nearest point of its border does. They count as
  // outside only beyond a tolerance, as rounding may put points of the border there.
  std::int64_t Read(Progress& progress)
  {
    double* points = this->Points->GetPointer(0);
    const double tolerance = this->Grid.BorderTolerance();
    std::atomic<std::int64_t> outside{ 0 };
    visitPoints(this->Input, "input point set", progress, [&](std::int64_t i, const double* x) {
      std::copy_n(x, 3, points + i * 3);
      double offset[D];
      this->Grid.template ToIndex<D>(x, offset);
      double* index = this->Index + i * D;
      std::copy_n(offset, D, index);
      if (this->Grid.template ClampToDomain<D>(index))
      {
        return;
      }
      for (int a = 0; a < D; ++a)
      {
        offset[a] -= index[a];
      }
      double v[3];
      this->Grid.template VectorToPhysical<D>(offset, v);
      if (std::hypot(v[0], v[1], v[2]) > tolerance)
      {
        ++outside;
      }
    });
    return outside;
  }

  // Takes the points back along the map from the uniform measure to the density (Section 4.2), in
  // place. Mass of the density thereby becomes uniform. The flow sorts the points, with one key
  // each.
  FlowReport Flow(const TransportPlan<D>& plan, Progress& progress)
  {
    const PointSpan<D> points(this->Index, this->Count);
    try
    {
      return plan.Backward(points, points, progress);
    }
    catch (const std::bad_alloc& caught)
    {
      const double sort = static_cast<double>(this->Count) * sizeof(std::int64_t);
      failOutOfMemory(caught, { this->Purpose, sort });
    }
  }

  // After Flow.
  void Correct(const AreaCorrection<D>& correction, Progress& progress)
  {
    // The corrections are found by where points were before the flow: the physical points still
    // have it.
    const double* points = this->Points->GetPointer(0);
    progress.ForEach(this->Count, grain, [=, &correction](std::int64_t i) {
      double point[D];
      this->Grid.template ToIndex<D>(points + i * 3, point);
      this->Grid.template ClampToDomain<D>(point);
      correction.Correct(point, this->Index + i * D);
    });
  }

  // Overwrites the index coordinates in 3D.
  void Write(double blend, Progress& progress, vtkPointSet* output)
  {
    // x becomes x + Blend (y - x), where x and y are the point before and after the flow in index
    // space. The displacement is added to the physical point, so that points that do not move keep
    // their bits.
    double* points = this->Points->GetPointer(0);
    double* displacements = this->Displacements->GetPointer(0);
    progress.ForEach(this->Count, grain, [=](std::int64_t i) {
      double* x = points + i * 3;
      double move[D];
      this->Grid.template ToIndex<D>(x, move);
      this->Grid.template ClampToDomain<D>(move);
      for (int a = 0; a < D; ++a)
      {
        move[a] = blend * (this->Index[i * D + a] - move[a]);
      }
      double* displacement = displacements + i * 3;
      this->Grid.template VectorToPhysical<D>(move, displacement);
      for (int r = 0; r < 3; ++r)
      {
        x[r] += displacement[r];
      }
    });
    vtkNew<vtkPoints> moved;
    moved->SetDataTypeToDouble();
    moved->SetData(this->Points);
    output->SetPoints(moved);
    output->GetPointData()->SetVectors(this->Displacements);
  }

private:
  static constexpr std::int64_t grain = std::int64_t{ 1 } << 14;

  const ImageGrid& Grid;
  vtkPointSet* Input;
  const std::int64_t Count;
  const std::string Purpose;
  vtkSmartPointer<vtkDoubleArray> Points;
  vtkSmartPointer<vtkDoubleArray> Displacements;
  LargeBuffer<double> Separate;
  double* Index;
};

// The steps of a run for a domain of D dimensions. With Blend 0 no point is advected, but the
// output has the same point arrays.
template <int D>
DensityEqualizingWarp::Report warp(const DensityEqualizingWarp& settings, InputDensity& density,
  vtkPointSet* input, FlowCache& cache, Progress& progress, vtkPointSet* output)
{
  const bool moves = settings.Blend > 0.0;
  const bool equalizes = moves && settings.EqualizeAreas;
  const OptimalSetting optimal = moves ? settings.Optimal : OptimalSetting();
  const double count = static_cast<double>(input->GetNumberOfPoints());
  const auto inputCells = static_cast<double>(moves ? input->GetNumberOfCells() : 0);
  const auto gridCells = static_cast<double>(density.Grid().NumberOfCells());
  // The correction is made for errors of the flow with just these options.
  const FlowOptions options =
    equalizes ? AreaCorrection<D>::OptionsFor(settings.Flow) : settings.Flow;
  // Weights are estimated nanoseconds: numbers of points, of grid cells and of vtkCells times the
  // cost of each.
  Stages stages(progress,
    { { "tables", Cost::tables(cache, density) }, { "reading", Cost::Seed * count },
      { "optimal map", Cost::optimal(cache, density, optimal) },
      { "points", moves ? Cost::flow(options, D) * count : 0.0 },
      { "areas", equalizes ? Cost::equalization(options, D) * gridCells : 0.0 },
      { "correction", equalizes ? Cost::Seed * count : 0.0 },
      { "cost", optimal.NeedsMap() ? Cost::flow(options, D) * gridCells : 0.0 },
      { "write", Cost::Seed * count }, { "inverted cells", Cost::InvertedCell * inputCells } });
  // Memory for the points is taken before the tables, which take longer.
  WarpedPoints<D> points(density.Grid(), input);
  const FlowTables tables = requireTables(chooseTables<D>(settings.Tables, density.Grid().Size<D>(),
    { options, FlowDirection::Backward, count, false,
      equalizes ? EqualAreas : optimal.WholeFor() }));
  const SharedFlow& shared = cache.Update(density, stages["tables"], tables, { optimal });
  if (!equalizes)
  {
    cache.ClearCorrection();
  }
  DensityEqualizingWarp::Report report;
  report.Outside = points.Read(stages["reading"]);
  int passes = 0;
  if (moves)
  {
    const TransportPlan<D> plan =
      cache.Plan<D>({ optimal }, options, density, stages["optimal map"]);
    report.Transport = TransportReport(plan);
    report.Flow = points.Flow(plan, stages["points"]);
    std::shared_ptr<const AreaCorrection<D>> correction;
    // A rank without points needs no correction, which is not collective, except for the cost of
    // the map.
    if (equalizes && (input->GetNumberOfPoints() > 0 || plan.Certificate()))
    {
      correction = cache.Correction<D>(plan, optimal, options, stages["areas"]);
      points.Correct(*correction, stages["correction"]);
      passes = correction->Report().Passes;
    }
    if (plan.Certificate())
    {
      const std::string purpose = "the images of " +
        std::to_string(density.Grid().NumberOfCells()) + " cells (" + optimal.Advice() + ")";
      // The cost is a sum over the centres of all cells of the density, of which each rank moves
      // its layers.
      const auto images = layersOf<D>(plan.Size(), progress.Group()).Count();
      const MemoryPlan memory{ purpose, static_cast<double>(images) * D * sizeof(double) };
      const double cost = withRequiredMemory(memory, [&]() {
        return costBackward<D>(
          density.Grid(), shared.Flow<D>(), plan, correction.get(), stages["cost"]);
      });
      addFieldValue(output, "TransportCost", cost);
      addBound<D>(plan, density.Grid(), cost, density.Grid(), output);
    }
  }
  points.Write(settings.Blend, stages["write"], output);
  // Collective: ranks without points agree on the passes with those that have some.
  report.IsUncorrected =
    equalizes && addEqualAreas(output, progress.Group(), passes, report.Flow) == 0;
  addSteps(output, { report.Flow });
  if (moves)
  {
    // Cells of the input turn over where the map folds between points; the caller warns of them.
    report.Cells = countInvertedCells(density.Grid(), input, output, stages["inverted cells"]);
  }
  return report;
}

} // namespace

InvertedCells countInvertedCells(
  const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after, Progress& progress)
{
  if (before->GetNumberOfCells() == 0 || before->GetNumberOfPoints() == 0)
  {
    return {};
  }
  return dispatchDimension(grid.Dimension(), count<1>, count<2>, count<3>)(
    grid, before, after, progress);
}

DensityEqualizingWarp::Report DensityEqualizingWarp::Run(InputDensity& density, vtkPointSet* input,
  FlowCache& cache, Progress& progress, vtkPointSet* output) const
{
  return dispatchDimension(density.Grid().Dimension(), warp<1>, warp<2>, warp<3>)(
    *this, density, input, cache, progress, output);
}

} // namespace RectifiedTransport::Bridge
