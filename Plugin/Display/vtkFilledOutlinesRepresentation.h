// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFilledOutlinesRepresentation
 * @brief   a surface with the areas within closed lines
 *
 * Maps of GDAL Vector Reader and the regions of vtkCartogram are closed lines, which other types of
 * representation show as lines. Lines with the same cell data are one region: what is inside an odd
 * number of them. With edges, the outlines of regions and polygons are drawn, not the triangles
 * within them. Polygons that are not convex are filled exactly. Other cells are shown as in a plain
 * surface.
 *
 * In ParaView the types Filled Outlines and Filled Outlines With Edges.
 */
#ifndef vtkFilledOutlinesRepresentation_h
#define vtkFilledOutlinesRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

class vtkActor;
class vtkCompositePolyDataMapper;
class vtkPolyDataAlgorithm;

class vtkFilledOutlinesRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkFilledOutlinesRepresentation* New();
  vtkTypeMacro(vtkFilledOutlinesRepresentation, vtkGeometryRepresentationWithFaces);

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;
  void SetVisibility(bool isVisible) override;

protected:
  vtkFilledOutlinesRepresentation();
  ~vtkFilledOutlinesRepresentation() override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;
  void UpdateColoringParameters() override;

private:
  void UpdateOutlines();
  bool HasEdges() const;

  vtkNew<vtkActor> Outlines;
  vtkNew<vtkCompositePolyDataMapper> OutlineMapper;
  vtkSmartPointer<vtkPolyDataAlgorithm> LinesOfPieces;

  vtkFilledOutlinesRepresentation(const vtkFilledOutlinesRepresentation&) = delete;
  void operator=(const vtkFilledOutlinesRepresentation&) = delete;
};

#endif
