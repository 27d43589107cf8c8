// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/OverlayParts.h"

#include "Bridge/Points/CellCheck.h"
#include "Bridge/Run/Inputs/InputBlock.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

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

} // namespace RectifiedTransport::Bridge
