// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkFilledOutlinesRepresentation.h"

#include "Bridge/Drawing/OutlineFilling.h"

#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkInformationRequestKey.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkPVView.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <exception>

namespace
{

class FillOutlines : public vtkPolyDataAlgorithm
{
public:
  static FillOutlines* New();
  vtkTypeMacro(FillOutlines, vtkPolyDataAlgorithm);

protected:
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    vtkPolyData* output = vtkPolyData::GetData(outputVector);
    output->ShallowCopy(vtkPolyData::GetData(inputVector[0]));
    try
    {
      RectifiedTransport::Bridge::fillOutlines(output);
      return 1;
    }
    catch (const std::exception& problem)
    {
      vtkErrorMacro(<< problem.what());
      return 0;
    }
  }
};

vtkStandardNewMacro(FillOutlines);

// The mapper of outlines draws lines alone; the surface has its own.
class LinesAlone : public vtkPolyDataAlgorithm
{
public:
  static LinesAlone* New();
  vtkTypeMacro(LinesAlone, vtkPolyDataAlgorithm);

protected:
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
    vtkPolyData* output = vtkPolyData::GetData(outputVector);
    output->SetPoints(input->GetPoints());
    output->SetLines(input->GetLines());
    return 1;
  }
};

vtkStandardNewMacro(LinesAlone);

} // namespace

vtkStandardNewMacro(vtkFilledOutlinesRepresentation);

vtkFilledOutlinesRepresentation::vtkFilledOutlinesRepresentation()
  : LinesOfPieces(vtkSmartPointer<LinesAlone>::New())
{
  vtkNew<FillOutlines> fill;
  fill->SetInputConnection(this->GeometryFilter->GetOutputPort());
  this->MultiBlockMaker->SetInputConnection(fill->GetOutputPort());
  this->OutlineMapper->ScalarVisibilityOff();
  // On top of the lines in the colours of the regions, which lie in the same place.
  this->OutlineMapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -4.0);
  this->Outlines->SetMapper(this->OutlineMapper);
  this->Outlines->PickableOff();
  this->Outlines->GetProperty()->LightingOff();
}

vtkFilledOutlinesRepresentation::~vtkFilledOutlinesRepresentation() = default;

bool vtkFilledOutlinesRepresentation::HasEdges() const
{
  return this->Representation == SURFACE_WITH_EDGES;
}

int vtkFilledOutlinesRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_RENDER())
  {
    this->LinesOfPieces->SetInputConnection(vtkPVRenderView::GetPieceProducer(inInfo, this));
    this->OutlineMapper->SetInputConnection(this->LinesOfPieces->GetOutputPort());
    this->UpdateOutlines();
  }
  return 1;
}

// The outlines look and lie as the edges of the surface.
void vtkFilledOutlinesRepresentation::UpdateOutlines()
{
  vtkProperty* property = this->Outlines->GetProperty();
  property->SetColor(this->Property->GetEdgeColor());
  property->SetLineWidth(this->Property->GetLineWidth());
  property->SetOpacity(this->Property->GetOpacity());
  this->Actor->ComputeMatrix();
  this->Outlines->SetUserMatrix(this->Actor->GetMatrix());
  this->Outlines->SetVisibility(this->GetVisibility() && this->HasEdges());
}

void vtkFilledOutlinesRepresentation::SetVisibility(bool isVisible)
{
  this->Superclass::SetVisibility(isVisible);
  this->Outlines->SetVisibility(isVisible && this->HasEdges());
}

bool vtkFilledOutlinesRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView || !this->Superclass::AddToView(view))
  {
    return false;
  }
  renderView->GetRenderer()->AddActor(this->Outlines);
  return true;
}

bool vtkFilledOutlinesRepresentation::RemoveFromView(vtkView* view)
{
  if (auto* renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetRenderer()->RemoveActor(this->Outlines);
  }
  return this->Superclass::RemoveFromView(view);
}

void vtkFilledOutlinesRepresentation::UpdateColoringParameters()
{
  this->Superclass::UpdateColoringParameters();
  this->Property->SetEdgeVisibility(false);
}
