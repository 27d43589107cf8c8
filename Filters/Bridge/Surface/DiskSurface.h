// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a vtkPolyData as a disk of triangles.
#ifndef RectifiedTransport_DiskSurface_h
#define RectifiedTransport_DiskSurface_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Mesh/DiskMesh.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <optional>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class DiskSurface
{
public:
  // Of an input with points. Cuts polygons and strips into triangles and checks that they are a
  // disk, as stages of the run up to the progress `end`. Points stay apart even where their
  // coordinates are equal. Throws Failure where the input has no polygons, coordinates that are not
  // finite, polygons that cannot be cut, or is no disk, and Cancelled.
  DiskSurface(vtkPolyData* input, Progress& progress, double end);

  const DiskMesh& Disk() const { return *this->Mesh; }

  // The input itself where all polygons are triangles and there are no strips, else its points,
  // vertices, lines and triangles, with all point and field data, and the cell data of the cells
  // that they are of (but for global ids, which would no longer be of one cell each).
  vtkPolyData* Triangulated() const { return this->Surface; }

  // The cell of Triangulated() that a triangle of the disk is: vtkPolyData numbers vertices, lines,
  // polygons, strips.
  vtkIdType CellOf(std::int64_t triangle) const { return this->FirstPolygon + triangle; }
  // The cell of the input that it was cut from.
  vtkIdType InputCellOf(std::int64_t triangle) const
  {
    return this->InputCells.size() > 0 ? this->InputCells.data()[triangle] : this->CellOf(triangle);
  }

private:
  // Fractions of the stages from `begin` to `end` of the run.
  struct Stages
  {
    Progress& Run;
    double Begin;
    double End;

    void Next(double part) const
    {
      this->Run.BeginStage(this->Begin + part * (this->End - this->Begin));
    }
  };

  void Triangulate(vtkPolyData* input, const Stages& stages);
  void FindInputCells(vtkPolyData* input, Progress& progress);
  void CopyCellData(vtkPolyData* input, Progress& progress);
  void MakeDisk(const LargeBuffer<double>& coordinates, const Stages& stages);

  vtkSmartPointer<vtkPolyData> Surface;
  vtkIdType FirstPolygon;
  LargeBuffer<vtkIdType> InputCells; // of triangles; empty where they are the input's
  std::optional<DiskMesh> Mesh;
};

} // namespace RectifiedTransport

#endif
