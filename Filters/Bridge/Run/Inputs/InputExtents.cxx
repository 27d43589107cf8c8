// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Inputs/InputExtents.h"

#include "Core/Messages/Failure.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkImageData.h"
#include "vtkInformationVector.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"

#include <array>
#include <cctype>
#include <limits>

namespace RectifiedTransport::Bridge
{

namespace
{

template <class Grid>
bool findExtentOf(vtkDataObject* data, std::array<int, 6>& extent)
{
  auto* grid = Grid::SafeDownCast(data);
  if (grid)
  {
    grid->GetExtent(extent.data());
  }
  return grid != nullptr;
}

void requireExtent(vtkDataObject* data, const std::string& name)
{
  std::array<int, 6> extent;
  const bool has = findExtentOf<vtkImageData>(data, extent) ||
    findExtentOf<vtkRectilinearGrid>(data, extent) ||
    findExtentOf<vtkStructuredGrid>(data, extent) ||
    findExtentOf<vtkExplicitStructuredGrid>(data, extent);
  if (has && !isReadable(extent.data()))
  {
    std::string first = name;
    first[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(first[0])));
    throw Failure(first + " has the extent " + textOfExtent(extent.data()) +
      "; each axis must end no earlier than it begins and have at most " +
      std::to_string(std::numeric_limits<int>::max()) + " points");
  }
}

} // namespace

void visitLeaves(vtkDataObject* data, const std::string& name, const VisitLeaf& visit)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    visit(data, name);
    return;
  }
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    visit(leaves->GetCurrentDataObject(),
      "block " + std::to_string(leaves->GetCurrentFlatIndex()) + " of " + name);
  }
}

void visitLeaves(vtkAlgorithm* filter, vtkInformationVector** inputVector, const VisitLeaf& visit)
{
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      visitLeaves(
        vtkDataObject::GetData(inputVector[port], i), "input port " + std::to_string(port), visit);
    }
  }
}

void requireExtents(vtkDataObject* data, const std::string& name)
{
  visitLeaves(data, name, requireExtent);
}

void requireExtents(vtkAlgorithm* filter, vtkInformationVector** inputVector)
{
  visitLeaves(filter, inputVector, requireExtent);
}

} // namespace RectifiedTransport::Bridge
