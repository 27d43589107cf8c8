// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCheckeredSurfaceRepresentation
 * @brief   a surface with a checkerboard laid on it by its texture coordinates
 *
 * Shows how texture coordinates stretch and shear a surface. The squares are light, so that the
 * colours of an array stay readable under them. Another texture, where one is set, replaces the
 * checkerboard. Data without texture coordinates are shown as a plain surface.
 *
 * In ParaView the types Checkerboard and Checkerboard With Edges of polygonal data. A type is part
 * of states and traces, works on a server, and needs no file, as a texture of the panel would.
 */
#ifndef vtkCheckeredSurfaceRepresentation_h
#define vtkCheckeredSurfaceRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkNew.h"

class vtkTexture;

class vtkCheckeredSurfaceRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkCheckeredSurfaceRepresentation* New();
  vtkTypeMacro(vtkCheckeredSurfaceRepresentation, vtkGeometryRepresentationWithFaces);

  /**
   * A texture instead of the checkerboard, or nullptr.
   */
  void SetTexture(vtkTexture* texture) override;

protected:
  vtkCheckeredSurfaceRepresentation();
  ~vtkCheckeredSurfaceRepresentation() override;

private:
  vtkNew<vtkTexture> Checkerboard;

  vtkCheckeredSurfaceRepresentation(const vtkCheckeredSurfaceRepresentation&) = delete;
  void operator=(const vtkCheckeredSurfaceRepresentation&) = delete;
};

#endif
