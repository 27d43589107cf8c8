// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/Cells/MeshCells.h"

#include "Bridge/Data/GhostFlags.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkOrderedTriangulator.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>

namespace RectifiedTransport::Bridge
{

namespace
{

// Asks an instance of each cell type for its dimension; 0 for numbers that are no type.
std::array<int, VTK_NUMBER_OF_CELL_TYPES> dimensionsOfTypes()
{
  std::array<int, VTK_NUMBER_OF_CELL_TYPES> dimensions;
  for (int type = 0; type < VTK_NUMBER_OF_CELL_TYPES; ++type)
  {
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    dimensions[static_cast<std::size_t>(type)] = cell ? cell->GetCellDimension() : 0;
  }
  return dimensions;
}

// The table is made at the first call, on any thread. Reading it is far cheaper than
// vtkGenericCell.
int dimensionOfType(int type)
{
  static const auto dimensions = dimensionsOfTypes();
  return type >= 0 && type < VTK_NUMBER_OF_CELL_TYPES ? dimensions[static_cast<std::size_t>(type)]
                                                      : 0;
}

// The table has VTK's numbers from VTK_EMPTY_CELL, 0, to VTK_HEXAHEDRON, 12. The core knows the
// order of their points; all other cells are divided into simplices.
CellShape shapeOfType(int type)
{
  constexpr std::array<CellShape, VTK_HEXAHEDRON + 1> shapes{ CellShape::Other, CellShape::Other,
    CellShape::Other, CellShape::Line, CellShape::PolyLine, CellShape::Triangle, CellShape::Other,
    CellShape::Polygon, CellShape::Pixel, CellShape::Quad, CellShape::Tetrahedron, CellShape::Voxel,
    CellShape::Hexahedron };
  return type >= 0 && type <= VTK_HEXAHEDRON ? shapes[static_cast<std::size_t>(type)]
                                             : CellShape::Other;
}

// Coordinates that are no doubles have single precision, or come from texts with few digits.
// The relative rounding lets cells of an image be recognised although filters computed their
// corners.
double roundingOf(vtkDataSet* data)
{
  // Some units in the last place: coordinates are results of a few operations, each of which
  // rounds.
  constexpr double ofFloats = 4.0 * std::numeric_limits<float>::epsilon();
  constexpr double ofDoubles = 16.0 * std::numeric_limits<double>::epsilon();
  const auto hasDoubles = [](auto* coordinates) {
    return !coordinates || coordinates->GetDataType() == VTK_DOUBLE;
  };
  bool areDoubles = true;
  if (auto* set = vtkPointSet::SafeDownCast(data))
  {
    areDoubles = hasDoubles(set->GetPoints());
  }
  else if (auto* grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    areDoubles = hasDoubles(grid->GetXCoordinates()) && hasDoubles(grid->GetYCoordinates()) &&
      hasDoubles(grid->GetZCoordinates());
  }
  return areDoubles ? ofDoubles : ofFloats;
}

// The coordinates in memory, 3 values a point, which are read without virtual calls. nullptr for
// other types and layouts, and for data sets that compute their points.
const double* coordinatesOf(vtkDataSet* data)
{
  auto* set = vtkPointSet::SafeDownCast(data);
  auto* doubles = set && set->GetPoints()
    ? vtkArrayDownCast<vtkDoubleArray>(set->GetPoints()->GetData())
    : nullptr;
  return doubles ? doubles->GetPointer(0) : nullptr;
}

// Quadratic cells that VTK does not divide, or divides by half.
bool isDividedByNodes(int type)
{
  return type == VTK_TRIQUADRATIC_HEXAHEDRON || type == VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON ||
    type == VTK_BIQUADRATIC_QUADRATIC_WEDGE || type == VTK_QUADRATIC_LINEAR_WEDGE;
}

void copyIds(vtkIdList* from, CellReader::Ids& to)
{
  to.assign(from->GetPointer(0), from->GetPointer(0) + from->GetNumberOfIds());
}

// Divides cells by VTK.
// It has VTK's objects for one cell, so that each thread needs its own.
class CellDivider
{
public:
  CellDivider() { this->Corners->SetDataTypeToDouble(); }

  // Writes the points of the simplices, dimension + 1 ids each, numbered in the data set. False if
  // VTK cannot divide the cell.
  bool Divide(vtkDataSet* data, vtkIdType number, CellReader::Ids& simplices)
  {
    data->GetCell(number, this->Cell);
    const int type = this->Cell->GetCellType();
    const int dimension = dimensionOfType(type);
    if (this->Cell->GetNumberOfPoints() <= dimension) // which VTK's strips do not expect
    {
      simplices.clear();
      return true;
    }
    if (isDividedByNodes(type))
    {
      // All cells of a type are divided in the same way, which is found once.
      CellReader::Ids& nodes = this->Nodes[type];
      if (nodes.empty())
      {
        this->DivideNodes(nodes);
      }
      simplices.clear();
      for (const std::int64_t node : nodes)
      {
        simplices.push_back(this->Cell->GetPointId(static_cast<int>(node)));
      }
      return true;
    }
    const bool isDivided = this->Cell->Triangulate(0, this->Found, this->Corners) != 0;
    copyIds(this->Found, simplices);
    // vtkPyramid divides itself, and then says that it has not where one diagonal is the shorter.
    return isDivided || (dimension == 3 && !simplices.empty());
  }

private:
  // The tetrahedra of the nodes of all cells of the type, by its parametric coordinates.
  void DivideNodes(CellReader::Ids& nodes)
  {
    const vtkIdType count = this->Cell->GetNumberOfPoints();
    vtkNew<vtkOrderedTriangulator> triangulator;
    // A Delaunay triangulation of the nodes in the unit cube of parametric coordinates. Points of
    // type 0 are inside, so that all tetrahedra of classification 0 together fill the cell.
    triangulator->InitTriangulation(0.0, 1.0, 0.0, 1.0, 0.0, 1.0, static_cast<int>(count));
    double* place = this->Cell->GetParametricCoords();
    for (vtkIdType i = 0; i < count; ++i, place += 3)
    {
      triangulator->InsertPoint(i, place, place, 0);
    }
    triangulator->Triangulate();
    vtkNew<vtkIdList> ids;
    vtkNew<vtkPoints> points;
    triangulator->AddTetras(0, ids, points);
    copyIds(ids, nodes);
  }

  vtkNew<vtkGenericCell> Cell;
  vtkNew<vtkIdList> Found;
  vtkNew<vtkPoints> Corners;
  std::map<int, CellReader::Ids> Nodes; // for each type of cells
};

// Each thread reads through an object of its own. The data set is only read, but VTK needs memory
// for the ids of the last cell.
class MeshReader final : public CellReader
{
public:
  explicit MeshReader(vtkDataSet* data)
    : Data(data)
    , Coordinates(coordinatesOf(data))
  {
  }

  CellShape ShapeOf(std::int64_t cell) const override
  {
    return shapeOfType(this->Data->GetCellType(cell));
  }
  int DimensionOf(std::int64_t cell) const override
  {
    return dimensionOfType(this->Data->GetCellType(cell));
  }
  const Ids& PointsOf(std::int64_t cell) override
  {
    this->Data->GetCellPoints(cell, this->Found);
    copyIds(this->Found, this->Points);
    return this->Points;
  }
  bool Divide(std::int64_t cell, Ids& simplices) override
  {
    const CellShape shape = this->ShapeOf(cell);
    // These are simplices as they are.
    if (shape == CellShape::Line || shape == CellShape::Triangle || shape == CellShape::Tetrahedron)
    {
      simplices = this->PointsOf(cell);
      return true;
    }
    // Made on demand: most meshes have no cells that only VTK can divide.
    if (!this->Divider)
    {
      this->Divider = std::make_unique<CellDivider>();
    }
    return this->Divider->Divide(this->Data, cell, simplices);
  }
  void GetPosition(std::int64_t point, double* x) const override
  {
    if (this->Coordinates)
    {
      std::copy_n(this->Coordinates + 3 * point, 3, x);
      return;
    }
    this->Data->GetPoint(point, x);
  }

private:
  vtkDataSet* const Data;
  const double* const Coordinates; // nullptr if they are not in one array of doubles
  vtkNew<vtkIdList> Found;
  Ids Points;
  std::unique_ptr<CellDivider> Divider;
};

} // namespace

MeshCells::MeshCells(vtkDataSet* data, const std::string& name)
  : Data(data)
{
  this->Name = name;
  this->NumberOfPoints = data->GetNumberOfPoints();
  this->NumberOfCells = data->GetNumberOfCells();
  this->Rounding = roundingOf(data);
  // Duplicate, hidden and refined cells do not count. Points that are duplicates keep their cells,
  // which have flags of their own; only hidden points hide theirs.
  this->HiddenCells = { ghostFlags(data, vtkDataObject::CELL, name.c_str()), ghostCell };
  this->HiddenPoints = { ghostFlags(data, vtkDataObject::POINT, name.c_str()),
    vtkDataSetAttributes::HIDDENPOINT };
}

std::unique_ptr<CellReader> MeshCells::Read() const
{
  return std::make_unique<MeshReader>(this->Data);
}

// The first volume ends the loop, as nothing has more dimensions.
int largestCellDimension(vtkDataSet* data)
{
  int largest = 0;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells() && largest < 3; ++cell)
  {
    largest = std::max(largest, dimensionOfType(data->GetCellType(cell)));
  }
  return largest;
}

} // namespace RectifiedTransport::Bridge
