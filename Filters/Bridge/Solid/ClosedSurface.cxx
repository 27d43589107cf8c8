// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Solid/ClosedSurface.h"

#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Solid/SurfaceOrientation.h"

#include "vtkArrayDispatch.h"
#include "vtkBoundingBox.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataArrayRange.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;
// Of work that reads memory at random, or sorts a little.
constexpr std::int64_t Slow = std::int64_t{ 1 } << 16;
constexpr std::int64_t Slower = std::int64_t{ 1 } << 14;

// What comes of cells of these sizes: a triangle for each point beyond the second.
std::int64_t countTriangles(vtkCellArray* cells)
{
  std::int64_t triangles = 0;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    triangles += std::max<std::int64_t>(0, cells->GetCellSize(cell) - 2);
  }
  return triangles;
}

using DispatchIds = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Integrals>;

// VTK's own range of the ids is kept, and does not follow what is written in place.
struct FindWrongId
{
  std::int64_t Points; // the ids are those below
  std::int64_t Wrong = -1;
  bool IsFound = false;

  template <class ArrayT>
  void operator()(ArrayT* ids)
  {
    for (const auto id : vtk::DataArrayValueRange<1>(ids))
    {
      const auto point = static_cast<std::int64_t>(id);
      if (point < 0 || point >= this->Points)
      {
        this->Wrong = point;
        this->IsFound = true;
        return;
      }
    }
  }
};

void requireIds(vtkCellArray* cells, std::int64_t points)
{
  vtkDataArray* ids = cells->GetConnectivityArray();
  FindWrongId find{ points };
  if (!DispatchIds::Execute(ids, find))
  {
    find(ids);
  }
  if (find.IsFound)
  {
    throw Failure("A polygon of the input surface has the point " + std::to_string(find.Wrong) +
      "; there are points 0 to " + std::to_string(points - 1));
  }
}

// Passes on the progress of a filter of VTK, and the host's wish to stop.
void runInside(vtkAlgorithm* filter, Progress& progress)
{
  const Context stage = progress.Stage();
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(const_cast<Context*>(&stage));
  observer->SetCallback([](vtkObject* caller, unsigned long, void* data, void* fraction) {
    const auto* context = static_cast<const Context*>(data);
    context->Report(*static_cast<double*>(fraction));
    if (context->IsCancelled && context->IsCancelled())
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  // What it cannot do is seen in its output, and said once.
  vtkNew<vtkCallbackCommand> quiet;
  quiet->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  filter->AddObserver(vtkCommand::ErrorEvent, quiet);
  filter->AddObserver(vtkCommand::WarningEvent, quiet);
  filter->Update();
  if (filter->GetAbortExecute())
  {
    throw Cancelled();
  }
}

// Polygons and strips as triangles, in the order of the polygons.
vtkSmartPointer<vtkCellArray> triangulate(
  vtkPoints* points, vtkCellArray* polygons, vtkCellArray* strips, Progress& progress)
{
  const std::int64_t expected = countTriangles(polygons) + countTriangles(strips);
  // vtkTriangleFilter ends the program when there is no memory for its cells to grow: at the end,
  // of an offset and three ids each, the old ones and twice as many new ones.
  requireMemory(std::to_string(expected) + " triangles of the input surface",
    static_cast<double>(expected) * 3.0 * 4.0 * sizeof(vtkIdType));
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(polygons);
  surface->SetStrips(strips);
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(surface);
  filter->PassVertsOff();
  filter->PassLinesOff();
  runInside(filter, progress);
  vtkCellArray* triangles = filter->GetOutput()->GetPolys();
  const std::int64_t missing = expected - triangles->GetNumberOfCells();
  if (missing != 0)
  {
    throw Failure("The input surface has polygons that cannot be cut into triangles: " +
      std::to_string(missing) +
      " triangles are missing; polygons must be simple: edges must not cross, and no corner be "
      "there twice");
  }
  return triangles;
}

struct CopyIds
{
  template <class ArrayT>
  void operator()(ArrayT* ids, std::int64_t* copy, Progress& progress) const
  {
    progress.For(ids->GetNumberOfValues(), Grain, [&](std::int64_t first, std::int64_t last) {
      std::int64_t* to = copy + first;
      for (const auto id : vtk::DataArrayValueRange<1>(ids, first, last))
      {
        *to++ = static_cast<std::int64_t>(id);
      }
    });
  }
};

struct MarkUsed
{
  template <class ArrayT>
  void operator()(ArrayT* ids, std::vector<unsigned char>& used) const
  {
    const auto count = static_cast<std::int64_t>(used.size());
    for (const auto id : vtk::DataArrayValueRange<1>(ids))
    {
      const auto point = static_cast<std::int64_t>(id);
      if (point >= 0 && point < count) // RequestData says it
      {
        used[static_cast<std::size_t>(point)] = 1;
      }
    }
  }
};

} // namespace

std::array<double, 6> polygonBounds(vtkPolyData* surface)
{
  std::array<double, 6> bounds{ 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  std::vector<unsigned char> used(static_cast<std::size_t>(surface->GetNumberOfPoints()), 0);
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    const MarkUsed mark;
    vtkDataArray* ids = cells->GetConnectivityArray();
    if (!DispatchIds::Execute(ids, mark, used))
    {
      mark(ids, used);
    }
  }
  if (std::find(used.begin(), used.end(), 1) != used.end())
  {
    vtkBoundingBox::ComputeBounds(surface->GetPoints(), used.data(), bounds.data());
  }
  return bounds;
}

ClosedSurface::ClosedSurface(vtkPolyData* input, Progress& progress, double end)
  : NumberOfPoints(input->GetNumberOfPoints())
{
  const std::string points = std::to_string(this->NumberOfPoints) + " points";
  const double begin = progress.StageEnd();
  const auto stage = [&progress, begin, end](
                       double part) { progress.BeginStage(begin + part * (end - begin)); };
  withMemory("the surface's " + points, static_cast<double>(this->NumberOfPoints) * 64.0, [&]() {
    this->Points = LargeBuffer<double>(3 * this->NumberOfPoints);
    double* copy = this->Points.data();
    stage(0.1);
    visitPoints(input, "input surface", progress,
      [copy](std::int64_t i, const double* x) { std::copy_n(x, 3, copy + 3 * i); });
  });
  if (input->GetNumberOfPolys() + input->GetNumberOfStrips() == 0)
  {
    throw Failure("The input surface has " + points +
      " and no polygons; a solid needs a closed surface of polygons (lines and vertices do not "
      "count)");
  }
  vtkCellArray* polygons = input->GetPolys();
  vtkCellArray* strips = input->GetStrips();
  requireIds(polygons, this->NumberOfPoints);
  requireIds(strips, this->NumberOfPoints);
  stage(0.25);
  withMemory("the table of the surface's " + points,
    static_cast<double>(this->NumberOfPoints) * 4.0 * sizeof(std::int64_t),
    [this, &progress]() { this->EnterPoints(progress); });
  vtkSmartPointer<vtkCellArray> triangles = polygons;
  if (strips->GetNumberOfCells() > 0 || polygons->IsHomogeneous() != 3)
  {
    stage(0.3);
    triangles = this->MergeCorners(polygons, progress);
    stage(0.4);
    triangles = triangulate(input->GetPoints(), triangles, strips, progress);
  }
  withMemory("the surface's " + std::to_string(triangles->GetNumberOfCells()) + " triangles",
    static_cast<double>(triangles->GetNumberOfCells()) * 9.0 * sizeof(std::int64_t), [&]() {
      stage(0.45);
      this->ReadTriangles(triangles, progress);
      stage(0.6);
      this->DropDegenerateTriangles(progress);
      this->RequireClosed(progress, end);
    });
}

void ClosedSurface::EnterPoints(Progress& progress)
{
  this->Equal = std::make_unique<MergePoints>(this->Points.data(), this->NumberOfPoints);
  MergePoints& equal = *this->Equal;
  progress.ForInOrder(
    this->NumberOfPoints, Grain,
    [&equal](std::int64_t first, std::int64_t last) { equal.Enter(first, last); }, Slow);
}

// The polygons without corners at the place of the one before, as at the poles of a sphere of
// quads; those of fewer than three corners are dropped.
vtkSmartPointer<vtkCellArray> ClosedSurface::MergeCorners(
  vtkCellArray* polygons, Progress& progress) const
{
  const vtkIdType cells = polygons->GetNumberOfCells();
  const vtkIdType ids = polygons->GetNumberOfConnectivityIds();
  requireMemory("the " + std::to_string(cells) + " polygons of the input surface",
    static_cast<double>(cells + 1 + ids) * sizeof(vtkIdType));
  auto merged = vtkSmartPointer<vtkCellArray>::New();
  merged->AllocateExact(cells, ids);
  vtkNew<vtkIdList> corners;
  progress.ForInOrder(
    cells, Grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t polygon = first; polygon < last; ++polygon)
      {
        polygons->GetCellAtId(polygon, corners);
        vtkIdType kept = 0;
        for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
        {
          const vtkIdType corner = this->Equal->First(corners->GetId(i));
          if (kept == 0 || corner != corners->GetId(kept - 1))
          {
            corners->SetId(kept++, corner);
          }
        }
        while (kept > 1 && corners->GetId(0) == corners->GetId(kept - 1))
        {
          --kept;
        }
        if (kept >= 3)
        {
          merged->InsertNextCell(kept, corners->GetPointer(0));
        }
      }
    },
    Slow);
  return merged;
}

void ClosedSurface::ReadTriangles(vtkCellArray* triangles, Progress& progress)
{
  this->Count = triangles->GetNumberOfCells();
  this->Triangles = LargeBuffer<std::int64_t>(3 * this->Count);
  vtkDataArray* ids = triangles->GetConnectivityArray();
  const CopyIds copy;
  if (!DispatchIds::Execute(ids, copy, this->Triangles.data(), progress))
  {
    copy(ids, this->Triangles.data(), progress);
  }
}

// Triangles with two corners at one point are dropped: their other two sides are then one edge.
void ClosedSurface::DropDegenerateTriangles(Progress& progress)
{
  const MergePoints& equal = *this->Equal;
  std::int64_t kept = 0;
  progress.ForInOrder(this->Count, Grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t triangle = first; triangle < last; ++triangle)
    {
      const std::int64_t* from = this->Triangles.data() + 3 * triangle;
      const std::int64_t ids[3] = { equal.First(from[0]), equal.First(from[1]),
        equal.First(from[2]) };
      if (ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0])
      {
        std::copy_n(ids, 3, this->Triangles.data() + 3 * kept++);
      }
    }
  });
  if (kept == 0)
  {
    throw Failure("The input surface has " + std::to_string(this->NumberOfPoints) +
      " points and no polygon of three different ones; a solid needs a closed surface");
  }
  this->Count = kept;
  this->Equal.reset();
}

void ClosedSurface::RequireClosed(Progress& progress, double end)
{
  const double begin = progress.StageEnd();
  this->Edges =
    std::make_unique<SurfaceEdges>(this->Triangles.data(), this->Count, this->NumberOfPoints);
  SurfaceEdges& edges = *this->Edges;
  progress.BeginStage(begin + 0.2 * (end - begin));
  progress.ForInOrder(
    this->Count, Grain,
    [&edges](std::int64_t first, std::int64_t last) { edges.Count(first, last); }, Slow);
  progress.BeginStage(begin + 0.5 * (end - begin));
  progress.ForInOrder(
    this->Count, Grain,
    [&edges](std::int64_t first, std::int64_t last) { edges.Sort(first, last); }, Slow);
  progress.BeginStage(end);
  progress.For(
    this->NumberOfPoints, Grain,
    [&edges](std::int64_t first, std::int64_t last) { edges.Pair(first, last); }, Slower);
  if (edges.Open() > 0 || edges.NonManifold() > 0)
  {
    std::ostringstream message;
    message << "The input surface is not closed: it has " << edges.Open()
            << (edges.Open() == 1 ? " open edge" : " open edges") << " and " << edges.NonManifold()
            << (edges.NonManifold() == 1 ? " non-manifold edge" : " non-manifold edges")
            << "; every edge must be one of exactly two triangles";
    throw Failure(message.str());
  }
}

TriangleSurface ClosedSurface::InCells(const ImageGrid& grid, Progress& progress, double end)
{
  double* points = this->Points.data();
  const double spacing = grid.Spacing()[0];
  const Eigen::Vector3d corner = grid.Origin();
  progress.BeginStage(0.5 * (progress.StageEnd() + end));
  progress.For(this->NumberOfPoints, Grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        points[3 * i + static_cast<std::int64_t>(a)] =
          (points[3 * i + static_cast<std::int64_t>(a)] - corner[static_cast<Eigen::Index>(a)]) /
          spacing;
      }
    }
  });
  progress.BeginStage(end);
  if (this->Edges->Reversed() > 0)
  {
    withMemory("the orientation of the surface's triangles",
      static_cast<double>(this->Count) * (sizeof(std::int64_t) + 1),
      [this, &progress]() { this->Orient(progress); });
  }
  this->Edges.reset();
  return { { this->Points.data(), this->NumberOfPoints }, this->Triangles.data(), this->Count };
}

void ClosedSurface::Orient(Progress& progress)
{
  SurfaceOrientation orientation(
    this->Points.data(), this->Triangles.data(), this->Count, *this->Edges);
  progress.ForInOrder(
    this->Count, Grain,
    [&orientation](std::int64_t first, std::int64_t last) { orientation.Visit(last - first); },
    Slow);
  orientation.Visit(1); // turns the last component
  if (!orientation.IsOrientable())
  {
    throw Failure("The input surface is not orientable: it has one side only, as a Klein bottle; "
                  "a solid needs a surface with an inside");
  }
}

} // namespace RectifiedTransport
