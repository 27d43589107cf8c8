// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/OverlayParts.h"

#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Run/Inputs/InputBlock.h"
#include "Bridge/Run/Memory.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace RectifiedTransport::Bridge
{

std::vector<OverlayPart> overlayParts(vtkDataObject* overlay, vtkDataObject* output)
{
  std::vector<OverlayPart> parts;
  const auto add = [&](vtkDataObject* part, vtkPointSet* made) {
    auto* input = requireBlock<vtkPointSet>(
      part, "Overlay", "a vtkPointSet, as Extract Surface makes one of it");
    requireReadableCells(input, "Overlay");
    made->CopyStructure(input);
    made->GetPointData()->PassData(input->GetPointData());
    made->GetCellData()->PassData(input->GetCellData());
    made->GetFieldData()->ShallowCopy(input->GetFieldData()); // VTK has given it the map's
    parts.push_back({ input, made });
  };
  auto* const blocks = vtkCompositeDataSet::SafeDownCast(overlay);
  if (!blocks)
  {
    add(overlay, vtkPointSet::SafeDownCast(output));
    return parts;
  }
  auto* const outputs = vtkCompositeDataSet::SafeDownCast(output);
  outputs->CopyStructure(blocks);
  outputs->GetFieldData()->ShallowCopy(blocks->GetFieldData());
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    vtkDataObject* const leaf = leaves->GetCurrentDataObject();
    const auto made = vtkSmartPointer<vtkDataObject>::Take(leaf->NewInstance());
    outputs->SetDataSet(leaves, made);
    add(leaf, vtkPointSet::SafeDownCast(made));
  }
  return parts;
}

void addOverlay(const std::vector<OverlayPart>& parts, MapOverlays& overlays, Progress& progress)
{
  for (const OverlayPart& part : parts)
  {
    std::vector<Point<3>> points(static_cast<std::size_t>(part.Input->GetNumberOfPoints()));
    visitPoints(part.Input, "Overlay", progress, [&](std::int64_t i, const double* x) {
      points[static_cast<std::size_t>(i)] = { x[0], x[1], x[2] };
    });
    overlays.AddOverlay(std::move(points));
  }
}

void writeOverlay(
  const MapOverlays& overlays, const std::vector<OverlayPart>& parts, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  std::int64_t before = 0;
  for (const OverlayPart& part : parts)
  {
    const std::int64_t count = part.Input->GetNumberOfPoints();
    const auto places = newArray<vtkDoubleArray>("Points", 3, count);
    progress.ForEach(count, grain, [&](std::int64_t i) {
      places->SetTypedTuple(i, overlays.OverlayPoint(static_cast<std::size_t>(before + i)).data());
    });
    vtkNew<vtkPoints> points;
    points->SetData(places);
    part.Output->SetPoints(points);
    before += count;
  }
}

} // namespace RectifiedTransport::Bridge
