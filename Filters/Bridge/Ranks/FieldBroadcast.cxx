// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/FieldBroadcast.h"

#include "Bridge/Ranks/DataSetBytes.h"
#include "Core/Parallel/Ranks.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace RectifiedTransport::Bridge
{

void broadcastFields(vtkFieldData* fields, const Ranks& ranks)
{
  if (!ranks.AreSeveral())
  {
    return;
  }
  Bytes bytes;
  if (ranks.Own() == 0)
  {
    vtkNew<vtkPoints> point; // without any VTK sends text, which rounds
    point->InsertNextPoint(0.0, 0.0, 0.0);
    vtkNew<vtkPolyData> carrier;
    carrier->SetPoints(point);
    carrier->GetFieldData()->ShallowCopy(fields);
    bytes = bytesOfDataSet(carrier);
  }
  const Bytes first = ranks.Gather(bytes).front();
  if (ranks.Own() > 0)
  {
    fields->ShallowCopy(dataSetOfBytes(first.data(), first.size())->GetFieldData());
  }
}

} // namespace RectifiedTransport::Bridge
