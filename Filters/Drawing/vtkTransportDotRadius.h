// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportDotRadius
 * @brief   the radius with which points are shown as discs or spheres, from their spacing
 *
 * The input is any vtkPointSet, whose points without ghosts count. The output is a vtkTable of one
 * row with the column `DotRadius`: half the distance that a fifth of the points are nearer to their
 * nearest neighbour. Dots of equal mass then touch where they are dense, and their area shows the
 * density. It is 0 without two points at different places.
 *
 * If there are several MPI ranks, each gives its part of the points, and all have the row.
 *
 * Cost: O(n log n) for n points. Memory: about 100 bytes a point while it runs.
 *
 * ParaView uses it for the first display of particles.
 *
 * @sa vtkTransportVectorWriter vtkTransportSampler
 */
#ifndef vtkTransportDotRadius_h
#define vtkTransportDotRadius_h

#include "vtkCollectiveAlgorithm.h"
#include "vtkRectifiedTransportDrawingModule.h" // for the export macro
#include "vtkTable.h"

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTDRAWING_EXPORT vtkTransportDotRadius : public vtkCollectiveAlgorithm
{
public:
  static vtkTransportDotRadius* New();
  vtkTypeMacro(vtkTransportDotRadius, vtkCollectiveAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The table of one row.
   */
  vtkTable* GetOutput() { return vtkTable::SafeDownCast(this->GetOutputDataObject(0)); }

protected:
  vtkTransportDotRadius();
  ~vtkTransportDotRadius() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkTransportDotRadius(const vtkTransportDotRadius&) = delete;
  void operator=(const vtkTransportDotRadius&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
